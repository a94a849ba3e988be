"""From pairs to Table 1: a row a scenario, all of them, and those in which nobody failed."""

from __future__ import annotations

import dataclasses
from collections import Counter
from collections.abc import Callable, Collection, Iterable, Iterator, Mapping, Sequence
from math import lcm

import numpy as np

from testbed.analysis.counting import NO_EVENT, NOTHING_TO_DO
from testbed.analysis.outline import TIMES
from testbed.analysis.statistics import (
    Clusters,
    Strata,
    Test,
    Values,
    holm,
    mcnemar,
    mean,
    median,
    proportion,
    signed_rank,
)
from testbed.studies.table1.optimum import both_optima
from testbed.studies.table1.pairing import Pair
from testbed.studies.table1.published import ALL, MEASURES, NO_FAILURES, SCENARIOS
from testbed.studies.table1.results import Analysis, Ratio, Row, Table
from testbed.studies.table1.times import seconds

__all__ = ["RANDOM", "Analysis", "Ratio", "Row", "Table", "analyse"]

RANDOM = "random"
Sample = tuple[Strata, Clusters]
"""Values by the scenario that was played, and for each value its initial state."""


def analyse(pairs: Iterable[Pair], mind: str, base: str, sure: Collection[str]) -> Analysis:
    """Both tables of the pairs of two robots; a table without pairs is None.

    In the scenarios of `sure` something exogenous is to happen (`counting.eventful`).
    """
    known, who = list(pairs), (mind, base)
    drawn = [pair for pair in known if pair.intended == RANDOM]
    played = [pair for pair in known if pair.intended != RANDOM]
    became: dict[str, Counter[str]] = {}
    for pair in known:
        became.setdefault(pair.intended, Counter())[pair.happened] += 1
    return Analysis(
        mind=mind,
        base=base,
        triggered=_table(played, lambda pair: _as_triggered(pair, sure), who) if played else None,
        random=_table(drawn, lambda pair: pair.happened, who) if drawn else None,
        became={name: dict(sorted(counts.items())) for name, counts in became.items()},
    )


def _as_triggered(pair: Pair, sure: Collection[str]) -> str:
    """The scenario played; but a pair without its event, or with nothing to do, is in none.

    Failures and goals that nothing achieves are told in the row of their scenario.
    """
    reason = pair.apart(sure)
    return reason if reason in (NO_EVENT, NOTHING_TO_DO) else pair.intended


def _table(
    pairs: Sequence[Pair], scenario_of: Callable[[Pair], str], who: tuple[str, str]
) -> Table:
    groups: dict[str, list[Pair]] = {}
    for pair in pairs:
        groups.setdefault(scenario_of(pair), []).append(pair)
    scenarios = {name: groups[name] for name in sorted(groups) if name.isdigit()}
    played = Counter(pair.intended for pair in pairs)
    # Weights in whole numbers: sums of them are exact, and what is alike stays alike.
    weights = {name: lcm(*played.values()) / count for name, count in played.items()}
    rows = _corrected([_row(*named, weights, who) for named in _rows(scenarios)])
    apart = {name: len(own) for name, own in sorted(groups.items()) if not name.isdigit()}
    return Table(tuple(rows), apart)


def _rows(scenarios: Mapping[str, list[Pair]]) -> Iterator[tuple[str, list[Pair]]]:
    yield from scenarios.items()
    everything = [pair for name, own in scenarios.items() if name in SCENARIOS for pair in own]
    yield ALL, everything
    for name, own in ((name, scenarios.get(name, [])) for name in ("3", "4")):
        yield name + NO_FAILURES, _without_failures(own)
    yield ALL + NO_FAILURES, _without_failures(everything)


def _without_failures(pairs: Iterable[Pair]) -> list[Pair]:
    """Without the pairs in which the traditional robot does not achieve the goal."""
    return [pair for pair in pairs if pair.base.correct or pair.base.lost]


def _row(
    name: str, pairs: Sequence[Pair], weights: Mapping[str, float], who: tuple[str, str]
) -> Row:
    counted = [pair for pair in pairs if pair.played]
    decided = [pair for pair in counted if pair.decided]
    ended = [pair for pair in counted if pair.ended]
    return Row(
        name=name,
        pairs=len(counted),
        lost=sum(pair.lost for pair in pairs),
        late=sum(pair.late and not pair.lost for pair in pairs),
        unsolvable=sum(not (pair.solvable or pair.lost or pair.late) for pair in pairs),
        out_of_reach=sum(p.mind.out_of_reach or p.base.out_of_reach for p in counted),
        meetings=dict(sorted(Counter(pair.meeting for pair in counted).items())),
        undecided=len(counted) - len(decided),
        intentional=proportion(*_sample(decided, weights, lambda pair: pair.mind.correct)),
        baseline=proportion(*_sample(decided, weights, lambda pair: pair.base.correct)),
        accuracy=_accuracy(decided, weights),
        ratios={measure: _ratio(ended, measure, weights) for measure in MEASURES},
        advantage=mean(*_sample(decided, weights, lambda p: p.mind.correct - p.base.correct)),
        optimum=dict(zip(who, both_optima(ended, weights), strict=True)),
        times=seconds(ended, {name: _times(ended, name, weights) for name in TIMES}, weights),
    )


def _accuracy(pairs: Sequence[Pair], weights: Mapping[str, float]) -> Test | None:
    minds = np.array([pair.mind.correct for pair in pairs], dtype=bool)
    bases = np.array([pair.base.correct for pair in pairs], dtype=bool)
    states = [pair.state for pair in pairs]
    return mcnemar(minds, bases, states, _weights_of(pairs, weights))


def _weights_of(pairs: Iterable[Pair], weights: Mapping[str, float]) -> Values:
    """What each pair weighs in the mean of its initial state."""
    return np.array([weights[pair.intended] for pair in pairs], dtype=float)


def _ratio(pairs: Sequence[Pair], measure: str, weights: Mapping[str, float]) -> Ratio:
    with_ratio = [pair for pair in pairs if pair.mind.measures[measure]]
    own = _sample(
        with_ratio, weights, lambda p: p.base.measures[measure] / p.mind.measures[measure]
    )
    differences = [pair.base.measures[measure] - pair.mind.measures[measure] for pair in pairs]
    states = [pair.state for pair in pairs]
    return Ratio(
        pairs=len(with_ratio),
        mean=mean(*own),
        median=median(*own),
        test=signed_rank(np.array(differences, dtype=float), states, _weights_of(pairs, weights)),
        of_sums=_of_sums(pairs, measure, weights),
    )


def _times(pairs: Sequence[Pair], name: str, weights: Mapping[str, float]) -> Ratio:
    """A ratio of times beside the published measures: it is tested as one of these, or not."""
    return dataclasses.replace(_ratio(pairs, name, weights), test=None)


def _of_sums(pairs: Sequence[Pair], measure: str, weights: Mapping[str, float]) -> float | None:
    own = [(weights[pair.intended], pair) for pair in pairs]
    below = sum(weight * pair.mind.measures[measure] for weight, pair in own)
    above = sum(weight * pair.base.measures[measure] for weight, pair in own)
    return above / below if below else None


def _sample(
    pairs: Iterable[Pair], weights: Mapping[str, float], value: Callable[[Pair], float]
) -> Sample:
    """By the scenario that was played: each counts as if it had been repeated like the others."""
    played: dict[str, list[Pair]] = {}
    for pair in pairs:
        played.setdefault(pair.intended, []).append(pair)
    strata = [(np.array([*map(value, own)], dtype=float), weights[n]) for n, own in played.items()]
    return strata, [[pair.state for pair in own] for own in played.values()]


def _corrected(rows: Sequence[Row]) -> list[Row]:
    """The rows with Holm's correction over all tests of the table."""
    tests = [test for row in rows for test in _tests(row)]
    corrected = iter(holm([test.p for test in tests]))

    def with_holm(test: Test | None) -> Test | None:
        return None if test is None else dataclasses.replace(test, holm=next(corrected))

    return [
        dataclasses.replace(
            row,
            accuracy=with_holm(row.accuracy),
            ratios={
                name: dataclasses.replace(ratio, test=with_holm(ratio.test))
                for name, ratio in row.ratios.items()
            },
        )
        for row in rows
    ]


def _tests(row: Row) -> list[Test]:
    """In the order in which they are corrected."""
    tests = [row.accuracy, *(ratio.test for ratio in row.ratios.values())]
    return [test for test in tests if test is not None]
