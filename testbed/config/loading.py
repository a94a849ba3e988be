"""Read a configuration: OmegaConf composes file and overrides, pydantic validates the result."""

import inspect
import json
import re
from collections.abc import Callable, Iterable, Iterator, Sequence
from pathlib import Path
from typing import Any, TypeVar, get_type_hints

from pydantic import BaseModel, ValidationError
from pydantic_core import ErrorDetails

from asp.language import load_description, nearest, suggestion
from testbed.config import models
from testbed.config.checking import Check, check
from testbed.config.composing import compose
from testbed.config.models import ExperimentConfig, Section
from testbed.config.places import ConfigError, Key, Places
from testbed.config.scenarios import with_scenarios

F = TypeVar("F", bound=Callable[..., object])

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
"""Texts that YAML 1.1 reads as a number or a truth value."""

SECTION = re.compile(rf"{re.escape(models.__name__)}\.(\w+)")
"""A section, as types are written."""

FINE_KEYS = ("levels", "level_sizes", "refinement", "draw", "statistics")
"""Keys that only configurations of the fine resolution have."""


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
        ConfigError: one line per error, each with its place and what would be right.
    """
    try:
        path = find_config(source)
        text = path.read_text(encoding="utf-8")
    except UnicodeDecodeError as error:
        raise ConfigError([f"{source}: not a text file in UTF-8 ({error.reason})"]) from None
    except OSError as error:
        message = str(error) if error.strerror is None else f"{source}: {error.strerror}"
        raise ConfigError([message]) from None
    places = Places(path, text, [item.partition("=")[0] for item in overrides], given_in)
    composed = compose(text, overrides, places)
    try:
        config = _located(ExperimentConfig.model_validate(composed), path)
    except ValidationError as error:
        found = error.errors(include_url=False)
        cut = {item["loc"][:-1] for item in found if _is_rest_of_literal(item)}
        kept = (item for item in found if item["type"] != "literal" or item["loc"][:-1] not in cut)
        meant = set(map(_meant_key, found))
        told = (item for item in kept if item["type"] != "missing" or item["loc"] not in meant)
        raise ConfigError([_describe(item, places) for item in told]) from None
    check(config, places, checks)
    if config.is_fine:
        return config
    return with_scenarios(config, load_description(config.domain).scenarios)


def _is_rest_of_literal(error: ErrorDetails) -> bool:
    """Whether a key is what YAML cut off from an unquoted literal, at a comma."""
    return error["type"] == "extra_forbidden" and ")" in str(error["loc"][-1])


def _meant_key(error: ErrorDetails) -> Key | None:
    """The key that an unknown one is a misspelling of; None: none, or it is known."""
    if error["type"] != "extra_forbidden":
        return None
    *section, name = error["loc"]
    near = nearest(str(name), _fields_of(section))
    return None if near is None else (*section, near)


def _describe(error: ErrorDetails, places: Places) -> str:
    key = error["loc"]
    where = places.of(key)
    if error["type"] == "extra_forbidden":
        return f"{where}: unknown key; {_known_key(key)}"
    if error["input"] == "":
        return f"{where}: has no value; give one, or null for none"
    if error["type"] == "missing":
        return f"{where}: is missing{_example(key)}{_or_level(key, error['input'])}"
    if error["type"] == "too_short":
        return f"{where}: should not be empty{_example(key)}"
    if error["type"] == "tuple_type":
        return f"{where}: should be a list such as [{_shown(error['input'])}]"
    message = error["msg"].removeprefix("Input ").replace("a valid integer", "an integer")
    message = message.replace("a valid ", "a ").replace("dictionary", "mapping")
    message = message[0].lower() + message[1:].partition(" or instance of")[0]
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
    near = suggestion(given, choices, otherwise="")
    return near and f"; {near}"


def _known_key(key: Key) -> str:
    """What an unknown key should be: in quotes, or one of its section."""
    if "(" in str(key[-1]) or ")" in str(key[-1]):
        return "put quotes around an action or a literal with a comma in it"
    return suggestion(str(key[-1]), _fields_of(key[:-1]))


def _fields_of(key: Iterable[str | int]) -> Iterable[str]:
    """The keys of the section that a key leads to."""
    section: type[BaseModel] = ExperimentConfig
    for part in key:
        inner = SECTION.search(str(get_type_hints(section).get(str(part))))
        section = getattr(models, inner[1]) if inner else section
    return section.model_fields


def _located(config: ExperimentConfig, path: Path) -> ExperimentConfig:
    """With the paths of files beside the configuration, or here; a packaged one keeps its name."""
    files = {"refinement": config.refinement} if config.refinement is not None else {}
    if config.domain.endswith(".al"):
        files["domain"] = config.domain
    for key, file in files.items():
        found = filter(Path.is_file, (path.parent / file, Path(file)))
        files[key] = str(next((candidate.resolve() for candidate in found), file))
    return config.model_copy(update=files)


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
    types = get_type_hints(ExperimentConfig)
    for name, own in ExperimentConfig.model_fields.items():
        kind = SECTION.sub(_keys_of, inspect.formatannotation(types[name]))
        plain = own.default_factory is None and not isinstance(own.default, Section)
        yield f"{name}: {kind}" + (f" = {own.default!r}" if plain and not own.is_required() else "")


def _keys_of(section: re.Match[str]) -> str:
    return f"{{{', '.join(getattr(models, section[1]).model_fields)}}}"


def lists_keys(function: F) -> F:
    """A decorator: the docstring ends with the keys, each of which is a keyword argument, too."""
    keys = "\n".join(f"    {line}" for line in listed_keys())
    title = "Keyword arguments beside these are keys of the configuration:"
    function.__doc__ = f"{inspect.cleandoc(function.__doc__ or '')}\n\n{title}\n\n{keys}\n"
    return function
