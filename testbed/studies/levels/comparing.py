"""Ours beside the published figures, for what can be compared across machines and solvers."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass

from testbed.analysis.statistics import Estimate
from testbed.studies.levels.published import NO_ZOOM, PARTS, ZOOM, Paper, Rounded
from testbed.studies.levels.results import Level

CONDITIONS = {ZOOM: "zoom", NO_ZOOM: "no zoom"}
RATIO = "no zoom / zoom"

Levels = Mapping[str, Level]


@dataclass(frozen=True)
class Cell:
    """Ours with its interval (of the mean, where there is a median), and the published value.

    `of_sums` is the ratio of sums beside a mean of ratios.
    """

    ours: Estimate | None
    median: Estimate | None = None
    published: Rounded | None = None
    of_sums: float | None = None

    @property
    def inside(self) -> bool | None:
        """Whether the published value lies in our interval; None where one of them is missing."""
        if self.ours is None or self.published is None:
            return None
        return self.ours.covers(self.published.value, self.published.half_digit)


@dataclass(frozen=True)
class Line:
    """A row of a table: a level, what is compared there, over how many trials or pairs.

    `robot` is the condition whose figures these are; "" where both are compared.
    """

    level: str
    what: str
    robot: str
    number: int
    cells: tuple[Cell, ...]


def shares(levels: Levels, paper: Paper) -> Iterator[Line]:
    """The shares of the trials that achieved their goal, a row a level and condition."""
    for name, level in levels.items():
        for robot, share in level.compared.completed.items():
            cell = Cell(share, published=paper.completed(name, robot))
            trials = level.reasoning[robot].trials
            yield Line(name, CONDITIONS.get(robot, robot), robot, trials, (cell,))


def ratios(levels: Levels, paper: Paper) -> Iterator[Line]:
    """No zoom / zoom by part of the time, a row a level that has pairs."""
    for name, level in levels.items():
        own = level.compared.ratios
        pairs = max(ratio.pairs for ratio in own.values())
        if pairs:
            cells = (
                Cell(own[p].mean, own[p].median, paper.ratio(name, p), own[p].of_sums)
                for p in PARTS
            )
            yield Line(name, RATIO, "", pairs, tuple(cells))


def growth(levels: Levels, paper: Paper) -> Iterator[Line]:
    """How many times a time is that at the first level, a row a level and condition."""
    for name, level in levels.items():
        for robot, own in level.compared.growth.items():
            published = (paper.growth(name, robot, part) for part in PARTS)
            grown = (own[part] for part in PARTS)
            cells = (Cell(g.mean, g.median, p) for g, p in zip(grown, published, strict=True))
            trials = level.reasoning[robot].trials
            yield Line(name, CONDITIONS.get(robot, robot), robot, trials, tuple(cells))


FEW = 20
"""Pairs of a level below which the start of a process is much of its times."""

FEW_PAIRS = "few pairs: the first trials also prepare what later ones use"


def has_few(lines: Iterable[Line]) -> bool:
    """Whether the times of a level are those of a few trials."""
    return any(line.number < FEW for line in lines)
