"""The descriptions at both resolutions that a configuration's levels, or its own map, stand for."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from functools import cache
from pathlib import Path

from asp.domains.levels import LEVELS, LevelSize, level_text
from asp.language import read_domain
from asp.refinement import Refinement, load, read_refinement
from testbed.config.models import ExperimentConfig


@dataclass(frozen=True)
class Ground:
    """A refinement and the text that it was read from, beside the coarse one."""

    refinement: Refinement
    text: str


def grounds(config: ExperimentConfig) -> Iterator[tuple[str, Ground]]:
    """The levels of a configuration by name; a map of one's own is called as its file is.

    Raises SourceError for a mistake in a map's texts, OSError where one cannot be read.
    """
    if config.refinement is not None:
        yield Path(config.refinement).stem, of_files(config.domain, config.refinement)
    for name in config.levels:
        yield name, of_size(level_size(config, name))


def level_size(config: ExperimentConfig, name: str) -> LevelSize:
    """The size of a published level, or of one of the configuration's own. Raises KeyError."""
    if name in LEVELS:
        return LEVELS[name]
    own = config.level_sizes[name]
    return LevelSize(own.rooms, own.rows, own.columns, own.objects)


@cache
def of_size(size: LevelSize) -> Ground:
    """The generated level of a size."""
    coarse, fine = level_text(size.rooms, size.rows, size.columns, size.objects)
    return Ground(load(coarse, "level.al", fine, "level.fine"), fine)


def of_files(domain: str, refinement: str) -> Ground:
    """A domain and its refinement, by names or paths. Raises SourceError and OSError."""
    file, text = read_domain(domain)
    fine_file, fine = read_refinement(refinement)
    return Ground(load(text, file, fine, fine_file), fine)
