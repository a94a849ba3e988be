"""The published values of the levels for other programs, beside ours in `summary.json`."""

from __future__ import annotations

from collections.abc import Iterable
from typing import TypeAlias

from testbed.studies.levels import comparing
from testbed.studies.levels.comparing import Cell, Levels, Line
from testbed.studies.levels.published import PARTS, Paper

Numbers: TypeAlias = dict[str, object]


def numbers(levels: Levels, paper: Paper) -> dict[str, Numbers]:
    """By level the published values, and whether they lie in our intervals.

    `completed` by robot, `ratios` by part of the time, `growth` by both: `published` and `inside`;
    `seconds` by both: `mean` and `sd`. What was not published is absent.
    """
    shares, ratios = list(comparing.shares(levels, paper)), list(comparing.ratios(levels, paper))
    growth = list(comparing.growth(levels, paper))
    found: dict[str, Numbers] = {
        name: {
            "completed": {line.robot: _beside(line.cells[0]) for line in _of(name, shares)},
            "ratios": {p: own for line in _of(name, ratios) for p, own in _parts(line).items()},
            "growth": {line.robot: _parts(line) for line in _of(name, growth)},
            "seconds": {robot: _seconds(name, robot, paper) for robot in level.reasoning},
        }
        for name, level in levels.items()
    }
    return {name: _without_nothing(own) for name, own in found.items()}


def _of(level: str, lines: Iterable[Line]) -> list[Line]:
    return [line for line in lines if line.level == level]


def _parts(line: Line) -> Numbers:
    return {part: _beside(cell) for part, cell in zip(PARTS, line.cells, strict=True)}


def _beside(cell: Cell) -> Numbers:
    if cell.published is None:
        return {}
    return {"published": cell.published.value, "inside": cell.inside}


def _seconds(level: str, robot: str, paper: Paper) -> Numbers:
    known = {part: paper.seconds(level, robot, part) for part in PARTS}
    return {p: {"mean": own[0], "sd": own[1]} for p, own in known.items() if own is not None}


def _without_nothing(values: Numbers) -> Numbers:
    """The same without empty parts, also inside of parts."""
    inner = {k: _without_nothing(v) if isinstance(v, dict) else v for k, v in values.items()}
    return {key: value for key, value in inner.items() if value != {}}
