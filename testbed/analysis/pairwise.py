"""What pairs of trials come to: how many count, accuracy by robot, ratios, tests of both robots."""

from __future__ import annotations

import dataclasses
from collections import Counter
from collections.abc import Callable, Collection, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from statistics import fmean

import numpy as np

from testbed.analysis.counting import BASELINE, INTENTIONAL, Apart, pair_apart
from testbed.analysis.optimum import Needed, Optimum, optimum
from testbed.analysis.outline import DIVIDED, MEASURES, TIMES, Outline
from testbed.analysis.statistics import Test, holm, mcnemar, signed_rank

ACCURACY = "accuracy"
COUNTS: Mapping[Apart, str] = {
    "incomplete": "incomplete",
    "lost": "failed_pairs",
    "deadline": "deadline",
    "unsolvable": "unsolvable",
    "nothing to do": "nothing_to_do",
    "no event": "without_event",
}
"""The keys under which pairs are counted apart."""
Both = tuple[Outline, Outline]
"""The traditional robot's trial, and the intentional one's."""


@dataclass(frozen=True)
class Played:
    """A pair: its id, the scenario that was played, the trials by robot."""

    pair: str
    scenario: str
    trials: Mapping[str, Outline]


@dataclass(frozen=True)
class Group:
    """What some pairs come to; `pairs` are the ids of those that count, `apart` counts the others.

    `errors` counts by robot the trials that its own error ended: they are not correct, and their
    measures, which are those of a part of a trial, are in no ratio and no test. `accuracy` is by
    robot, of the trials of which it is known whether they are correct; `undecided` counts the
    others.
    Tests are by measure, of the traditional less the intentional robot's, and of `accuracy`, of the
    intentional less the traditional one's.
    """

    pairs: frozenset[str]
    apart: Mapping[Apart, int]
    errors: Mapping[str, int]
    accuracy: Mapping[str, float | None]
    undecided: Mapping[str, int]
    ratios: Mapping[str, float | None]
    of_sums: Mapping[str, float | None]
    tests: Mapping[str, Test | None]
    optimum: Mapping[str, Optimum]

    def values(self) -> dict[str, object]:
        """As they are in a summary."""
        tests = self.tests.items()
        return {
            "pairs": len(self.pairs),
            **{key: self.apart.get(reason, 0) for reason, key in COUNTS.items()},
            "robot_errors": dict(self.errors),
            "accuracy": dict(self.accuracy),
            "undecided": dict(self.undecided),
            "ratios": {name: self.ratios[name] for name in MEASURES},
            "ratios_of_sums": {name: self.of_sums[name] for name in MEASURES},
            "times": {
                name: {"ratio": self.ratios[name], "of_sums": self.of_sums[name]} for name in TIMES
            },
            "p_values": {name: None if test is None else test.p for name, test in tests},
            "holm": {name: None if test is None else test.holm for name, test in tests},
            "effects": {name: None if test is None else test.effect for name, test in tests},
            "optimum": {robot: own.values() for robot, own in self.optimum.items()},
        }


def group(pairs: Sequence[Played], robots: Collection[str], sure: Collection[str]) -> Group:
    """Of pairs of a run of these robots; `sure` are the eventful scenarios (`counting`)."""
    reasons = [_apart(pair, robots, sure) for pair in pairs]
    counted = [pair for pair, reason in zip(pairs, reasons, strict=True) if reason is None]
    own = [robot for robot in robots if any(robot in pair.trials for pair in pairs)]
    both = [
        (pair.trials[BASELINE], pair.trials[INTENTIONAL])
        for pair in counted
        if {BASELINE, INTENTIONAL} <= set(pair.trials)
    ]
    ended = [(base, mind) for base, mind in both if base.ended and mind.ended]
    return Group(
        pairs=frozenset(pair.pair for pair in counted),
        apart=Counter(reason for reason in reasons if reason is not None),
        errors={robot: sum(not t.ended for t in _trials(counted, robot)) for robot in own},
        accuracy={robot: _accuracy(_trials(counted, robot)) for robot in own},
        undecided={robot: _undecided(_trials(counted, robot)) for robot in own},
        ratios={name: _ratio(ended, measure) for name, measure in DIVIDED.items()},
        of_sums={name: _of_sums(ended, measure) for name, measure in DIVIDED.items()},
        tests=dict(_tests(both)),
        optimum={robot: _optimum(_trials(counted, robot)) for robot in own},
    )


def _apart(pair: Played, robots: Collection[str], sure: Collection[str]) -> Apart | None:
    standings = {robot: trial.standing for robot, trial in pair.trials.items()}
    return pair_apart(pair.scenario, standings, robots, sure)


def _trials(pairs: Iterable[Played], robot: str) -> list[Outline]:
    return [pair.trials[robot] for pair in pairs if robot in pair.trials]


def _accuracy(trials: Sequence[Outline]) -> float | None:
    known = [trial.correct for trial in trials if trial.decided]
    return fmean(known) if known else None


def _undecided(trials: Iterable[Outline]) -> int:
    return sum(not trial.decided for trial in trials)


def _ratio(pairs: Sequence[Both], measure: Callable[[Outline], float]) -> float | None:
    ratios = [measure(base) / measure(mind) for base, mind in pairs if measure(mind)]
    return fmean(ratios) if ratios else None


def _of_sums(pairs: Sequence[Both], measure: Callable[[Outline], float]) -> float | None:
    below = sum(measure(mind) for _, mind in pairs)
    return sum(measure(base) for base, _ in pairs) / below if below else None


def _tests(pairs: Sequence[Both]) -> Iterator[tuple[str, Test | None]]:
    ended = [(base, mind) for base, mind in pairs if base.ended and mind.ended]
    for name, measure in MEASURES.items():
        differences = [measure(base) - measure(mind) for base, mind in ended]
        yield name, signed_rank(np.array(differences, dtype=float), _states(ended))
    decided = [pair for pair in pairs if all(trial.decided for trial in pair)]
    bases, minds = (np.array([pair[i].correct for pair in decided], dtype=bool) for i in (0, 1))
    yield ACCURACY, mcnemar(minds, bases, _states(decided))


def _states(pairs: Iterable[Both]) -> list[str]:
    return [mind.state for _, mind in pairs]


def _optimum(trials: Iterable[Outline]) -> Optimum:
    achieved = [trial for trial in trials if trial.achieved and trial.ended]
    return optimum(
        Needed({name: measure(trial) for name, measure in MEASURES.items()}, trial.minimal)
        for trial in achieved
    )


def corrected(groups: Sequence[Group]) -> list[Group]:
    """The groups with Holm's correction over all of their tests.

    Groups of the same pairs, as of a scenario that is the only one of its level, are one.
    """
    distinct = {own.pairs: own for own in groups}.values()
    tests = [test for own in distinct for test in own.tests.values() if test is not None]
    found = iter(holm([test.p for test in tests]))
    known = {
        own.pairs: {name: _with_holm(test, found) for name, test in own.tests.items()}
        for own in distinct
    }
    return [dataclasses.replace(own, tests=known[own.pairs]) for own in groups]


def _with_holm(test: Test | None, found: Iterator[float]) -> Test | None:
    return None if test is None else dataclasses.replace(test, holm=next(found))
