"""What explains a difference from the published table: our pairs, and its own rows."""

from collections import Counter
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from math import log
from statistics import fmean

import numpy as np
from scipy.optimize import nnls  # type: ignore[import-untyped]  # scipy ships no types

from papers.table1.pairs import Pair
from testbed.analysis.bootstrap import Estimate
from testbed.studies.table1.measures import Row, Table
from testbed.studies.table1.published import (
    ALL,
    MEASURES,
    NO_FAILURES,
    PUBLISHED,
    SCENARIOS,
    Published,
)
from testbed.studies.tables import HALF_DIGIT

WITHOUT_SECONDS = ("plans", "execution_units", "actions")
"""The measures that do not depend on how fast a machine or a solver is."""
ACCURACY = "accuracy"


@dataclass(frozen=True)
class Blindness:
    """The traditional robot in pairs whose event undid a part of the goal, and in the others."""

    undone: int
    undone_right: int
    others: int
    others_right: int


def blindness(pairs: Iterable[Pair]) -> Blindness:
    """How often the traditional robot is right, with and without a part of the goal undone."""
    decided = (pair.baseline for pair in pairs if pair.played and pair.decided)
    counts = Counter((side.undone, side.correct) for side in decided)
    return Blindness(
        undone=counts[True, True] + counts[True, False],
        undone_right=counts[True, True],
        others=counts[False, True] + counts[False, False],
        others_right=counts[False, True],
    )


def published_weights() -> tuple[dict[str, float], float]:
    """How the published rows 1 to 5 must be weighted to give the row of all; the largest misfit.

    By least squares with weights that are not negative and come to 1, of the columns that are
    means over pairs.
    """
    rows = [_columns(PUBLISHED[name]) for name in SCENARIOS]
    sum_to_one = 10.0
    matrix = np.array([[*row, sum_to_one] for row in rows]).T
    wanted = np.array([*_columns(PUBLISHED[ALL]), sum_to_one])
    weights, _ = nnls(matrix, wanted)
    misfit = float(np.abs(matrix @ weights - wanted)[:-1].max())
    return dict(zip(SCENARIOS, map(float, weights / weights.sum()), strict=True)), misfit


def _columns(row: Published) -> list[float]:
    return [*(row.ratios[measure] for measure in MEASURES), row.baseline]


def shares(table: Table) -> dict[str, float]:
    """Which part of a table's pairs is in each scenario from 1 to 5; 0 where none is in any."""
    counts = {row.name: row.pairs for row in table.rows if row.name in SCENARIOS}
    whole = sum(counts.values()) or 1
    return {name: counts.get(name, 0) / whole for name in SCENARIOS}


def published_failures(scenario: str) -> dict[str, float]:
    """The mean ratios of the published pairs in which the traditional robot fails.

    They follow from a row, its accuracy, and the row without failures.
    """
    row, rest = PUBLISHED[scenario], PUBLISHED[scenario + NO_FAILURES]
    return {
        name: (row.ratios[name] - row.baseline * rest.ratios[name]) / (1 - row.baseline)
        for name in MEASURES
    }


def mean_ratios(pairs: Sequence[Pair]) -> dict[str, float | None]:
    """The mean ratios of some pairs; None where none has a ratio."""
    return {name: _mean_ratio(pairs, name) for name in MEASURES}


def _mean_ratio(pairs: Sequence[Pair], name: str) -> float | None:
    own = [
        pair.baseline.measures[name] / pair.treatment.measures[name]
        for pair in pairs
        if pair.treatment.measures[name]
    ]
    return fmean(own) if own else None


@dataclass(frozen=True)
class Closeness:
    """How near a table comes to the published one.

    `inside` of `values` published values lie in our intervals; `distance` is the mean of
    |ln(ours / published)| over the ratios that do not depend on seconds.
    """

    inside: int
    values: int
    distance: float


def closeness(table: Table, rows: Iterable[str] = SCENARIOS) -> Closeness:
    """Of these rows, plans, execution units, actions and the traditional robot's accuracy."""
    known = list(_beside(table.rows, rows))
    distances = [
        abs(log(ours.value / theirs))
        for _, column, ours, theirs in known
        if column != ACCURACY and ours.value
    ]
    inside = [bool(ours.covers(theirs, HALF_DIGIT)) for *_, ours, theirs in known]
    return Closeness(sum(inside), len(inside), fmean(distances) if distances else 0.0)


@dataclass(frozen=True)
class Outside:
    """A published value that does not lie in our interval; `column` is a measure, or `accuracy`."""

    row: str
    column: str
    ours: float
    published: float


def outside(table: Iterable[Row], rows: Iterable[str] = SCENARIOS) -> Iterator[Outside]:
    """The published values that `closeness` does not count as inside."""
    for name, column, ours, theirs in _beside(table, rows):
        if ours.covers(theirs, HALF_DIGIT) is False:
            yield Outside(name, column, ours.value, theirs)


def _beside(
    table: Iterable[Row], rows: Iterable[str]
) -> Iterator[tuple[str, str, Estimate, float]]:
    """Row, column, our estimate and the published value, where there are both."""
    for row in (row for row in table if row.name in rows):
        paper = PUBLISHED[row.name]
        means = [(name, row.ratios[name].mean, paper.ratios[name]) for name in WITHOUT_SECONDS]
        for column, ours, theirs in (*means, (ACCURACY, row.baseline, paper.baseline)):
            if ours is not None:
                yield row.name, column, ours, theirs


def plans_made(pairs: Iterable[Pair]) -> Mapping[int, int]:
    """How many pairs have how many plans of the traditional robot."""
    return dict(sorted(Counter(int(pair.baseline.measures["plans"]) for pair in pairs).items()))
