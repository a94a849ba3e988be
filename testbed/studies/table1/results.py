"""What the analysis of pairs gives: rows, tables, both ways of drawing."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field

from testbed.analysis.optimum import Optimum
from testbed.analysis.statistics import Estimate, Test
from testbed.studies.table1.pairing import Meeting
from testbed.studies.table1.published import PUBLISHED, Published


@dataclass(frozen=True)
class Ratio:
    """A measure of the traditional robot, divided by the intentional one's.

    `pairs` have a ratio: the intentional robot's measure is not 0. The test compares the measures
    themselves; its effect is above 0 where the traditional robot needed more. `of_sums` is the
    ratio of the sums over all pairs, each with its weight.
    """

    pairs: int
    mean: Estimate | None
    median: Estimate | None
    test: Test | None
    of_sums: float | None = None


@dataclass(frozen=True)
class Seconds:
    """Seconds of process time per trial, the means of both robots, and what their ratio is."""

    baseline: float | None
    intentional: float | None
    ratio: Ratio


@dataclass(frozen=True)
class Row:
    """A row of the table; `pairs` are those counted; `lost`, `late`, `unsolvable` those left out.

    `undecided` pairs count, but in no accuracy: of these it is not known whether both trials were
    correct.
    The test of the accuracies has its effect above 0 where the intentional robot was right more
    often; `advantage` is that difference of the proportions with its interval. `out_of_reach` are
    goals that could not be achieved any more where a trial ended. `optimum` is by robot,
    `times` by the name of the measure: planning, diagnosis, and both.
    """

    name: str
    pairs: int
    lost: int
    unsolvable: int
    out_of_reach: int
    meetings: Mapping[Meeting, int]
    intentional: Estimate | None
    baseline: Estimate | None
    accuracy: Test | None
    ratios: Mapping[str, Ratio]
    advantage: Estimate | None = None
    optimum: Mapping[str, Optimum] = field(default_factory=dict)
    undecided: int = 0
    times: Mapping[str, Seconds] = field(default_factory=dict)
    late: int = 0


@dataclass(frozen=True)
class Table:
    """One way of assigning pairs to scenarios; `apart` counts the pairs that are in no row.

    `published` are the rows of the paper that it is to be compared with, by name.
    """

    rows: tuple[Row, ...]
    apart: Mapping[str, int]
    published: Mapping[str, Published] = field(default_factory=lambda: PUBLISHED)


@dataclass(frozen=True)
class Analysis:
    """What the pairs of two robots come to.

    `triggered`: by the scenario that was played; `random`: by the scenario that a random event came
    to be. `became` counts the pairs by both: which scenario was played, and what it came to be.
    """

    mind: str
    base: str
    triggered: Table | None
    random: Table | None
    became: Mapping[str, Mapping[str, int]]
