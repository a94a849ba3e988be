"""The configurations of a sweep: one for each of its conditions."""

import re
from collections.abc import Mapping, Sequence
from functools import lru_cache
from typing import Any

import msgspec
from omegaconf import OmegaConf

from asp.language import load_description
from testbed.config.composing import REFUSALS, read_yaml
from testbed.config.models import ExperimentConfig
from testbed.config.places import ConfigError
from testbed.config.scenarios import with_scenarios
from testbed.config.sweep import RANGE

PARTS = re.compile(r"""(?:"(?:\\.|[^"\\])*"|'[^']*'|\[[^\]]*\]|\{[^}]*\}|\([^)]*\)|[^,"'\[{(])+""")
"""Parts between commas that are in no quotes and no brackets; brackets of a kind are not nested."""

SECTION = re.compile(r"[.\[]")
"""Behind the first key of a dotted one."""


def conditions_of(config: ExperimentConfig) -> dict[str, ExperimentConfig]:
    """The configuration under each condition, by the condition's name; of no sweep itself, by "".

    None of them has a sweep; the keys that the sweep does not vary are those of `config`.
    """
    if not config.is_sweep:
        return {"": config}
    return dict(_of_sweep(_Given(config)))


class _Given:
    """A configuration by the keys that were given, of which equal ones have equal conditions."""

    def __init__(self, config: ExperimentConfig) -> None:
        self.config = config
        self._text = config.model_dump_json(exclude_unset=True)

    def __hash__(self) -> int:
        return hash(self._text)

    def __eq__(self, other: object) -> bool:
        return isinstance(other, _Given) and self._text == other._text


@lru_cache(maxsize=2)
def _of_sweep(given: _Given) -> Mapping[str, ExperimentConfig]:
    config = given.config
    cells = config.sweep.cells.items()
    found = {name: ExperimentConfig.model_validate(varied(config, own)) for name, own in cells}
    if config.is_fine:
        return found
    known = load_description(config.domain).scenarios
    return {name: with_scenarios(own, known) for name, own in found.items()}


def varied(config: ExperimentConfig, keys: Mapping[str, Any]) -> dict[str, Any]:
    """The keys that were given, with these dotted ones in place of theirs, and without the sweep.

    Raises an error of OmegaConf, or ValueError or TypeError, for a key that leads nowhere.
    """
    given = config.model_dump(mode="json", exclude_unset=True, exclude={"sweep"})
    first = {SECTION.split(key, maxsplit=1)[0] for key in keys}
    # Only what these keys lead into: OmegaConf takes long for a whole configuration.
    changed = OmegaConf.create({key: value for key, value in given.items() if key in first})
    for key, value in keys.items():
        OmegaConf.update(changed, key, value, merge=value != {}, force_add=True)
    composed: Any = OmegaConf.to_container(changed)
    return given | {str(key): value for key, value in composed.items()}


def with_sweep(overrides: Sequence[str]) -> list[str]:
    """Overrides of which those with several values, or a range, are of the grid of a sweep.

    Values stand between commas that are in no brackets and no quotes: `a,b` are two, `[a,b]` is
    one. Raises ConfigError.
    """
    grid: dict[str, object] = {}
    fixed = []
    for item in overrides:
        key, _, value = item.partition("=")
        parts = PARTS.findall(value)
        if RANGE.match(value):
            grid[key] = value
        elif len(parts) > 1:
            grid[key] = [_value(key, part) for part in parts]
        else:
            fixed.append(item)
    return [*fixed, f"sweep.grid={msgspec.json.encode(grid).decode()}"] if grid else fixed


def _value(key: str, text: str) -> object:
    try:
        return read_yaml(text)
    except REFUSALS as error:
        problem = getattr(error, "problem", None) or str(error).splitlines()[0]
        raise ConfigError([f"command line: {key}: '{text}' is not YAML: {problem}"]) from None
