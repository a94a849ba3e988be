"""Read a configuration: OmegaConf composes file and overrides, pydantic validates the result."""

from __future__ import annotations

import inspect
import json
import re
from collections.abc import Callable, Iterator, Mapping, Sequence
from pathlib import Path
from typing import Any, TypeVar

from pydantic import BaseModel, ValidationError
from pydantic_core import ErrorDetails

import asp
from asp.language import suggestion
from testbed.config.checking import Check, check
from testbed.config.composing import compose
from testbed.config.models import ExperimentConfig, Section
from testbed.config.places import ConfigError, Key, Places
from testbed.config.scenarios import with_scenarios

Schema = Mapping[str, Any]
F = TypeVar("F", bound=Callable[..., object])

_TYPES = {"integer": "int", "number": "float", "string": "str", "boolean": "bool", "null": "None"}

LONGEST = 80
"""How much of a value a line shows."""

FORMS = {
    "int_type": "; write it in decimal digits alone, without quotes",
    "float_type": "; write it in decimal, without quotes",
    "bool_type": "; write true or false",
    "string_type": "; put it in quotes",
}
"""How the values of a type are written, by the error that they are not of it."""

LIKE_A_VALUE = re.compile(r"^[-+.]*\d|^\.(inf|nan)$|^(y|n|yes|no|on|off)$", re.IGNORECASE)
"""What YAML 1.1 takes for a number or a truth value."""

FINE_KEYS = ("levels", "level_sizes", "refinement", "draw", "statistics")
"""What a configuration of the fine resolution may have given."""


def load_config(
    source: str | Path,
    overrides: Sequence[str] = (),
    checks: Sequence[Check] = (),
    given_in: str = "command line",
) -> ExperimentConfig:
    """The validated configuration of a file or a packaged name, with dotted overrides applied.

    A `domain` given as a path, and a `refinement`, are taken relative to the configuration, and
    are absolute in the answer. `checks` are those of what the configuration calls by name, such
    as its robots. `given_in` is what errors call the place of the overrides.

    Raises:
        ConfigError: one line an error, each with its place and what would be right.
    """
    path, text = _read(source)
    places = Places(path, text, [item.partition("=")[0] for item in overrides], given_in)
    composed = compose(text, overrides, places)
    config = _located(_validate(composed, places), path)
    check(config, places, checks)
    if config.is_fine:
        return config
    return with_scenarios(config, asp.load_description(config.domain).scenarios)


def _read(source: str | Path) -> tuple[Path, str]:
    try:
        path = find_config(source)
        return path, path.read_text(encoding="utf-8")
    except UnicodeDecodeError as error:
        raise ConfigError([f"{source}: not a text file in UTF-8 ({error.reason})"]) from None
    except OSError as error:
        message = str(error) if error.strerror is None else f"{source}: {error.strerror}"
        raise ConfigError([message]) from None


def _validate(composed: dict[str, Any], places: Places) -> ExperimentConfig:
    try:
        return ExperimentConfig.model_validate(composed)
    except ValidationError as error:
        lines = [_describe(item, places) for item in error.errors(include_url=False)]
        raise ConfigError(lines) from None


def _describe(error: ErrorDetails, places: Places) -> str:
    key = error["loc"]
    where = places.of(key)
    if error["type"] == "extra_forbidden":
        return f"{where}: unknown key; {_unknown_key_hint(str(key[-1]), _known_keys(key[:-1]))}"
    if error["input"] == "":
        return f"{where}: has no value; give one, or null for none"
    if error["type"] == "missing":
        return f"{where}: is missing{_example(key)}{_or_level(key, error['input'])}"
    if error["type"] == "too_short":
        return f"{where}: should not be empty{_example(key)}"
    if error["type"] == "tuple_type":
        return f"{where}: should be a list such as [{_shown(error['input'])}]"
    message = error["msg"].removeprefix("Input ").replace("a valid integer", "an integer")
    message = message.replace("a valid ", "a ").partition(" or instance of")[0]
    message = message[0].lower() + message[1:]
    return f"{where}: {message}, not {_shown(error['input'])}{_hint(error)}"


def _shown(value: object) -> str:
    """A value as YAML writes it, of a long one the beginning."""
    if value is None or isinstance(value, bool):
        return json.dumps(value)
    text = repr(value)
    return text if len(text) <= LONGEST else f"{text[:LONGEST]}..."


def _example(key: Key) -> str:
    field = ExperimentConfig.model_fields.get(str(key[0])) if len(key) == 1 else None
    return f"; for example {field.examples[0]}" if field and field.examples else ""


def _or_level(key: Key, given: Any) -> str:
    """Of a goal that is missing beside what belongs to levels: these may be what is."""
    if key != ("goal",) or not any(name in given for name in FINE_KEYS):
        return ""
    return "; or give levels, as in levels: [L1], or a refinement: there goals are drawn"


def _hint(error: ErrorDetails) -> str:
    """What would be right: the form that the type has in YAML, or the nearest choice."""
    given = error["input"]
    if error["type"] in FORMS and (
        isinstance(given, float | int) or LIKE_A_VALUE.search(str(given))
    ):
        return FORMS[error["type"]]
    expected = error.get("ctx", {}).get("expected")
    if expected is None or not isinstance(given, str):
        return ""
    choices = str(expected).replace("'", "").replace(" or ", ", ").split(", ")
    near = suggestion(given, choices)
    return f"; {near}" if near.startswith("did") else ""


def _unknown_key_hint(key: str, known: Sequence[str]) -> str:
    if "(" in key or ")" in key:
        return "put quotes around an action or a literal with a comma in it"
    return suggestion(key, known)


def _known_keys(parents: tuple[str | int, ...]) -> list[str]:
    section: type[BaseModel] = ExperimentConfig
    for part in parents:
        if isinstance(part, str) and part in section.model_fields:
            section = _section_in(section.model_fields[part].annotation) or section
    return list(section.model_fields)


def _section_in(annotation: Any) -> type[Section] | None:
    if isinstance(annotation, type) and issubclass(annotation, Section):
        return annotation
    inner = (_section_in(part) for part in getattr(annotation, "__args__", ()))
    return next((found for found in inner if found is not None), None)


def _located(config: ExperimentConfig, path: Path) -> ExperimentConfig:
    found = {"domain": config.domain} if config.domain.endswith(".al") else {}
    if config.refinement is not None:
        found["refinement"] = config.refinement
    return config.model_copy(update={key: _beside(path, file) for key, file in found.items()})


def _beside(path: Path, file: str) -> str:
    """The file beside the configuration or here; a packaged one keeps its bare name."""
    found = (candidate for candidate in (path.parent / file, Path(file)) if candidate.is_file())
    return str(next((candidate.resolve() for candidate in found), file))


SUFFIX = ".yaml"


def config_folder() -> Path:
    """The folder of the packaged configurations.

    A wheel carries them inside the package; a checkout keeps them beside it.
    """
    package = Path(__file__).resolve().parent.parent
    inside = package / "configs"
    return inside if inside.is_dir() else package.parent / "configs"


def config_names() -> list[str]:
    """Names under which a packaged configuration can be asked for, sorted."""
    return sorted(path.stem for path in config_folder().glob("*" + SUFFIX))


def find_config(source: str | Path) -> Path:
    """Path of a configuration given by path or by bare name (`quickstart`).

    Raises:
        FileNotFoundError: with one line that names the nearest packaged configurations.
    """
    path = Path(source)
    if path.is_file():
        return path
    if path.is_dir():
        raise FileNotFoundError(f"{source}: is a folder; a configuration is a {SUFFIX} file")
    packaged = config_folder() / (path.name + SUFFIX)
    if path.name == str(source) and packaged.is_file():
        return packaged
    raise FileNotFoundError(f"{source}: no such file; {suggestion(path.stem, config_names())}")


def listed_keys() -> Iterator[str]:
    """One line per key: `name: type = default`; of a section the names of its own keys."""
    schema = ExperimentConfig.model_json_schema()
    for name, own in schema["properties"].items():
        plain = "default" in own and not isinstance(own["default"], dict)
        yield f"{name}: {_type(own, schema)}" + (f" = {own['default']!r}" if plain else "")


def lists_keys(function: F) -> F:
    """A decorator: the docstring ends with the keys, each of which is a keyword argument, too."""
    keys = "\n".join(f"    {line}" for line in listed_keys())
    title = "Keyword arguments beside these are keys of the configuration:"
    function.__doc__ = f"{inspect.cleandoc(function.__doc__ or '')}\n\n{title}\n\n{keys}\n"
    return function


def _type(own: Schema, schema: Schema) -> str:
    if "$ref" in own:
        section = schema["$defs"][own["$ref"].rpartition("/")[2]]["properties"]
        return "{" + ", ".join(section) + "}"
    if "anyOf" in own:
        return " | ".join(dict.fromkeys(_type(one, schema) for one in own["anyOf"]))
    if "enum" in own:
        return " | ".join(map(repr, own["enum"]))
    if own.get("type") == "array":
        items = own.get("prefixItems") or [own["items"]]
        return f"list of {', '.join(dict.fromkeys(_type(item, schema) for item in items))}"
    if own.get("type") == "object":
        return f"names with {_type(own['additionalProperties'], schema)}"
    return _TYPES.get(str(own.get("type")), "any")
