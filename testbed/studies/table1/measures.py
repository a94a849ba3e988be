"""From pairs to Table 1: one row per scenario, all of them, and those in which nobody failed."""

from __future__ import annotations

import dataclasses
from collections import Counter
from collections.abc import Callable, Collection, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from math import lcm
from statistics import fmean
from typing import TypeAlias

from testbed.analysis import Run
from testbed.analysis.bootstrap import Estimate
from testbed.analysis.comparison import LEAST, TIMES, eventful
from testbed.analysis.statistics import Test
from testbed.config import ExperimentConfig
from testbed.studies.pairs import Ratio, Sample, corrected
from testbed.studies.table1.load import Meeting, Pair, Side, pairs_of
from testbed.studies.table1.published import (
    ALL,
    BASELINE,
    INTENTIONAL,
    MEASURES,
    NO_FAILURES,
    PUBLISHED,
    SCENARIOS,
    Published,
)
from testbed.world import load_world

RANDOM = "random"
Optimum: TypeAlias = Mapping[str, float | None]
"""What a robot needed over the least that achieves the goal, by measure; of how many `trials`."""


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

    @property
    def tables(self) -> dict[str, Table]:
        """Those that there are, by name."""
        both = {"triggered": self.triggered, "random": self.random}
        return {name: table for name, table in both.items() if table is not None}


def measures(run: Run, as_published: bool) -> list[Analysis]:
    """Each robot with activities against the traditional one.

    The published figures are those of one robot; these of all scenarios together are of five.
    """
    world, sure = load_world(run.config.domain), eventful(run.config)
    found = [
        analyse(pairs_of(run.trials, world, mind, BASELINE), mind, BASELINE, sure)
        for mind in minds_of(run.config)
    ]
    whole = set(SCENARIOS) <= set(run.config.scenarios)
    paper = PUBLISHED if as_published else {}
    parts = {name: row for name, row in paper.items() if whole or not name.startswith(ALL)}
    return [
        _beside(own, *((parts, paper) if own.mind == INTENTIONAL else ({}, {}))) for own in found
    ]


def _beside(
    own: Analysis, triggered: Mapping[str, Published], random: Mapping[str, Published]
) -> Analysis:
    """The same beside these published rows."""
    return dataclasses.replace(
        own,
        triggered=own.triggered and dataclasses.replace(own.triggered, published=triggered),
        random=own.random and dataclasses.replace(own.random, published=random),
    )


def minds_of(config: ExperimentConfig) -> tuple[str, ...]:
    """The robots of a configuration with activities, where the baseline is there, too."""
    if BASELINE not in config.robots:
        return ()
    return tuple(name for name in config.robots if name.startswith(INTENTIONAL))


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
    return pair.apart(sure) or pair.intended


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
    rows = corrected([_row(name, _sample(own, weights), who) for name, own in _rows(scenarios)])
    apart = {name: len(own) for name, own in sorted(groups.items()) if not name.isdigit()}
    return Table(tuple(rows), apart)


def _sample(pairs: Sequence[Pair], weights: Mapping[str, float]) -> Sample[Pair]:
    """Each scenario that was played counts as if it had been repeated like the others."""
    return Sample(pairs, lambda pair: pair.intended, weights, lambda pair: pair.state)


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


def _row(name: str, sample: Sample[Pair], who: tuple[str, str]) -> Row:
    counted = sample.where(lambda pair: pair.played)
    decided, ended = counted.where(lambda pair: pair.decided), counted.where(lambda p: p.ended)
    pairs = counted.pairs
    return Row(
        name=name,
        pairs=len(pairs),
        lost=sum(pair.lost for pair in sample.pairs),
        late=sum(pair.late and not pair.lost for pair in sample.pairs),
        unsolvable=sum(not (pair.solvable or pair.lost or pair.late) for pair in sample.pairs),
        out_of_reach=sum(pair.mind.out_of_reach or pair.base.out_of_reach for pair in pairs),
        meetings=dict(sorted(Counter(pair.meeting for pair in pairs).items())),
        undecided=len(pairs) - len(decided.pairs),
        intentional=decided.share(lambda pair: pair.mind.correct),
        baseline=decided.share(lambda pair: pair.base.correct),
        accuracy=decided.mcnemar(lambda pair: pair.mind.correct, lambda pair: pair.base.correct),
        ratios={measure: _ratio(ended, measure) for measure in MEASURES},
        advantage=decided.mean(lambda pair: pair.mind.correct - pair.base.correct),
        optimum=dict(zip(who, _optima(ended), strict=True)),
        times={name: _seconds(ended, name) for name in TIMES},
    )


def _ratio(sample: Sample[Pair], measure: str) -> Ratio:
    return sample.ratio(lambda p: p.base.measures[measure], lambda p: p.mind.measures[measure])


def _seconds(sample: Sample[Pair], name: str) -> Seconds:
    """Beside the published measures: what is tested is one of these, or not."""
    weights = [sample.weights[pair.intended] for pair in sample.pairs]

    def mean(sides: Sequence[Side]) -> float | None:
        return fmean([s.measures[name] for s in sides], weights=weights) if sides else None

    return Seconds(
        baseline=mean([pair.base for pair in sample.pairs]),
        intentional=mean([pair.mind for pair in sample.pairs]),
        ratio=dataclasses.replace(_ratio(sample, name), test=None),
    )


def _optima(sample: Sample[Pair]) -> tuple[Optimum, Optimum]:
    """How far both robots are from the least that achieves the goal."""
    return _optimum(sample, lambda pair: pair.mind), _optimum(sample, lambda pair: pair.base)


def _optimum(sample: Sample[Pair], side: Callable[[Pair], Side]) -> Optimum:
    known = [
        (side(pair).measures, pair.minimal, sample.weights[pair.intended])
        for pair in sample.pairs
        if side(pair).achieved and all(pair.minimal.get(name) for name in LEAST)
    ]
    weights = [weight for _, _, weight in known]
    means = {
        name: fmean([own[name] / least[name] for own, least, _ in known], weights=weights)
        for name in LEAST
        if known
    }
    return {"trials": len(known), **dict.fromkeys(LEAST), **means}
