"""Read a configuration: OmegaConf composes file and overrides, pydantic validates the result."""

from __future__ import annotations

import json
from collections.abc import Collection, Mapping, Sequence
from pathlib import Path
from typing import Any

import yaml
from omegaconf import OmegaConf
from omegaconf.errors import OmegaConfBaseException
from pydantic import BaseModel, ValidationError
from pydantic_core import ErrorDetails

import asp
from asp.spelling import suggestion
from testbed.config.checking import Robots, check
from testbed.config.errors import ConfigError
from testbed.config.models import ExperimentConfig, Section
from testbed.config.places import Key, Places
from testbed.resources import find_config

SCRIPT, NONE = "script", "none"
"""What a run without scenarios is called, in which a script is played, or nothing happens."""

FINE_KEYS = ("levels", "level_sizes", "refinement", "draw", "statistics")
"""What a configuration of the fine resolution may have given."""


def load_config(
    source: str | Path,
    overrides: Sequence[str] = (),
    robots: Robots | None = None,
    given_in: str = "command line",
    starters: Collection[str] = (),
) -> ExperimentConfig:
    """The validated configuration of a file or a packaged name, with dotted overrides applied.

    A `domain` given as a path, and a `refinement`, are taken relative to the configuration, and
    are absolute in the answer. `robots`, where given, says which kinds of robot may be asked
    for. `given_in` is what errors call the place of the overrides. `starters` are the robots that
    never act on the world at step 1, so that a script cannot have an event there beside them unless
    `exogenous_while_thinking`.

    Raises:
        ConfigError: one line an error, each with its place and what would be right.
    """
    path, text = _read(source)
    composed = _compose(path, text, overrides, given_in)
    places = Places(path, text, [item.partition("=")[0] for item in overrides], given_in)
    config = _located(_validate(composed, places), path)
    check(config, places, robots, starters)
    return config if config.scenarios or config.is_fine else _with_scenarios(config)


def _with_scenarios(config: ExperimentConfig) -> ExperimentConfig:
    """All that there is to play: a script, or else the domain's scenarios.

    Where there is neither, nothing exogenous happens: a script without entries.
    """
    if config.script is not None:
        return config.model_copy(update={"scenarios": (SCRIPT,)})
    scenarios = asp.load_description(config.domain).scenarios
    if scenarios:
        return config.model_copy(update={"scenarios": scenarios})
    return config.model_copy(update={"scenarios": (NONE,), "script": ()})


def _read(source: str | Path) -> tuple[Path, str]:
    try:
        path = find_config(source)
        return path, path.read_text(encoding="utf-8")
    except UnicodeDecodeError as error:
        raise ConfigError([f"{source}: not a text file in UTF-8 ({error.reason})"]) from None
    except OSError as error:
        message = str(error) if error.strerror is None else f"{source}: {error.strerror}"
        raise ConfigError([message]) from None


def _compose(path: Path, text: str, overrides: Sequence[str], given_in: str) -> dict[str, Any]:
    try:
        base = OmegaConf.to_container(OmegaConf.create(text))
    except yaml.YAMLError as error:
        raise ConfigError([_yaml_line(path, error)]) from None
    except OmegaConfBaseException as error:
        raise ConfigError([f"{path}: {_first_line(error)}"]) from None
    if not isinstance(base, dict) or not all(isinstance(key, (str, int)) for key in base):
        raise ConfigError([f"{path}: should hold `key: value` lines"])
    return _override(path, _string_keys(base), overrides, given_in)


def _override(
    path: Path, base: dict[str, Any], overrides: Sequence[str], given_in: str
) -> dict[str, Any]:
    composed = OmegaConf.create(base)
    for item in overrides:
        key, equals, value = item.partition("=")
        if not (equals and key.strip()):
            raise ConfigError([f"{given_in}: '{item}': an override is KEY=VALUE, e.g. limit=5"])
        try:
            given = OmegaConf.from_dotlist([f"value={value}"])["value"]
            OmegaConf.update(composed, key.strip(), given, merge=given != {}, force_add=True)
        except (yaml.YAMLError, OmegaConfBaseException, ValueError, TypeError, IndexError) as error:
            raise ConfigError([f"{given_in}: {key}: {_first_line(error)}"]) from None
    try:
        resolved = OmegaConf.to_container(composed, resolve=True, throw_on_missing=True)
    except OmegaConfBaseException as error:
        raise ConfigError([f"{path}: {_first_line(error)}"]) from None
    composed_keys: dict[str, Any] = _string_keys(resolved)
    return composed_keys


def _string_keys(value: Any) -> Any:
    """Keys as text at every depth: `4:` and `"4":` name the same scenario."""
    if isinstance(value, Mapping):
        return {str(key): _string_keys(item) for key, item in value.items()}
    return [_string_keys(item) for item in value] if isinstance(value, list) else value


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
    if error["type"] == "missing":
        return f"{where}: is missing{_example(key)}{_or_level(key, error['input'])}"
    if error["type"] == "too_short":
        return f"{where}: should not be empty{_example(key)}"
    if error["type"] == "tuple_type":
        return f"{where}: should be a list such as [{_shown(error['input'])}]"
    message = error["msg"].removeprefix("Input ").replace("a valid integer", "an integer")
    message = message.replace("a valid ", "a ")
    message = message[0].lower() + message[1:]
    return f"{where}: {message}, not {_shown(error['input'])}{_choice_hint(error)}"


def _shown(value: object) -> str:
    """A value as YAML writes it."""
    if value is None or isinstance(value, bool):
        return json.dumps(value)
    return repr(value)


def _example(key: Key) -> str:
    field = ExperimentConfig.model_fields.get(str(key[0])) if len(key) == 1 else None
    return f"; for example {field.examples[0]}" if field and field.examples else ""


def _or_level(key: Key, given: Any) -> str:
    """Of a goal that is missing beside what belongs to levels: these may be what is."""
    if key != ("goal",) or not any(name in given for name in FINE_KEYS):
        return ""
    return "; or give levels, as in levels: [L1], or a refinement: there goals are drawn"


def _choice_hint(error: ErrorDetails) -> str:
    expected = error.get("ctx", {}).get("expected")
    if expected is None or not isinstance(error["input"], str):
        return ""
    choices = str(expected).replace("'", "").replace(" or ", ", ").split(", ")
    near = suggestion(error["input"], choices)
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


def _yaml_line(path: Path, error: yaml.YAMLError) -> str:
    mark = getattr(error, "problem_mark", None)
    where = f"{path}:{mark.line + 1}:{mark.column + 1}" if mark else str(path)
    return f"{where}: not YAML: {getattr(error, 'problem', None) or _first_line(error)}"


def _first_line(error: Exception) -> str:
    return str(error).strip().splitlines()[0] if str(error).strip() else type(error).__name__
