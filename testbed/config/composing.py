"""Compose a configuration: the keys of a file, overrides of them, and interpolations in both."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import yaml
from omegaconf import DictConfig, OmegaConf
from omegaconf.errors import OmegaConfBaseException

from testbed.config.errors import ConfigError
from testbed.config.models import FINE_STEPS, ExperimentConfig, Limits
from testbed.config.places import Places, parsed
from testbed.config.yaml_core import read_scalar, read_yaml


def compose(text: str, overrides: Sequence[str], places: Places) -> dict[str, Any]:
    """The keys and values of a text in YAML with dotted overrides, interpolations resolved.

    Raises:
        ConfigError: one line for the first thing that cannot be read or resolved.
    """
    try:
        composed = OmegaConf.create(_mapping(text, places))
    except yaml.YAMLError as error:
        raise ConfigError([_yaml_line(places.file, error)]) from None
    except (OmegaConfBaseException, RecursionError) as error:
        raise ConfigError([f"{places.file}: {_first_line(error)}"]) from None
    for item in overrides:
        _override(composed, item, places)
    given: Any = OmegaConf.to_container(composed)
    values: dict[str, Any] = _as_given(given, _resolved(given, places))
    return values


def _mapping(text: str, places: Places) -> dict[str, Any]:
    found = read_yaml(text) or {}
    if not isinstance(found, dict):
        raise ConfigError([f"{places.file}: should hold `key: value` lines"])
    return found


def _override(composed: DictConfig, item: str, places: Places) -> None:
    key, equals, value = item.partition("=")
    if not (equals and key.strip()):
        wanted = f"'{item}': an override is KEY=VALUE, e.g. limit=5"
        raise ConfigError([f"{places.elsewhere}: {wanted}"])
    try:
        given = read_yaml(value)
        OmegaConf.update(composed, key.strip(), given, merge=given != {}, force_add=True)
    except (
        yaml.YAMLError,
        OmegaConfBaseException,
        ValueError,
        TypeError,
        IndexError,
        RecursionError,
    ) as error:
        problem = getattr(error, "problem", None) or _first_line(error)
        raise ConfigError([f"{places.elsewhere}: {key}: {problem}"]) from None


def _resolved(given: Mapping[str, Any], places: Places) -> Any:
    """The values with interpolations resolved, which may be of keys that were not given."""
    everything = OmegaConf.create(_filled(given, _defaults(given)))
    try:
        return OmegaConf.to_container(everything, resolve=True, throw_on_missing=True)
    except (OmegaConfBaseException, RecursionError) as error:
        key = parsed(getattr(error, "full_key", None) or "")
        raise ConfigError([f"{places.of(key)}: {_first_line(error)}"]) from None


def _defaults(given: Mapping[str, Any]) -> dict[str, Any]:
    fine = given.get("levels") or given.get("refinement")
    limits = Limits(steps=FINE_STEPS) if fine else Limits()
    blank = ExperimentConfig.model_construct(name="", goal=(), limits=limits)
    return blank.model_dump(mode="json", exclude={"name", "goal"})


def _filled(given: Mapping[str, Any], defaults: Mapping[str, Any]) -> dict[str, Any]:
    inner = {
        key: _filled(value, defaults[key])
        for key, value in given.items()
        if isinstance(value, Mapping) and isinstance(defaults.get(key), Mapping)
    }
    return {**defaults, **given, **inner}


def _as_given(given: Any, resolved: Any) -> Any:
    """The part that was given; the text of an interpolation is read as if it stood there."""
    if isinstance(given, dict):
        return {key: _as_given(value, resolved[key]) for key, value in given.items()}
    if isinstance(given, list):
        return [_as_given(*both) for both in zip(given, resolved, strict=True)]
    interpolated = isinstance(resolved, str) and resolved != given
    return read_scalar(resolved) if interpolated else resolved


def _yaml_line(file: str, error: yaml.YAMLError) -> str:
    mark = getattr(error, "problem_mark", None)
    where = f"{file}:{mark.line + 1}:{mark.column + 1}" if mark else file
    return f"{where}: not YAML: {getattr(error, 'problem', None) or _first_line(error)}"


def _first_line(error: Exception) -> str:
    return str(error).strip().splitlines()[0] if str(error).strip() else type(error).__name__
