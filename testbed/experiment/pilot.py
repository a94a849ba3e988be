"""What a sweep will take, estimated from a pair of each condition and scenario, played first."""

from collections import Counter
from collections.abc import Sequence
from contextlib import closing

from testbed.experiment.record import TrialRecord
from testbed.experiment.specs import TrialSpec
from testbed.experiment.status import Estimate
from testbed.experiment.worker_pool import Results

MOST = 24
"""Pairs that are played first; where there are more conditions and scenarios, spread evenly."""

Stratum = tuple[str, str, str]
"""Condition, scenario and level: trials of one take about as long as each other."""


class Pilot:
    """The order in which trials are played, and what the first ones say of all.

    `order` is that of the trials: first a pair of each stratum, then the others as planned.
    `estimates` are one per condition; they have their seconds once the first pairs are played.
    """

    def __init__(self, specs: Sequence[TrialSpec]) -> None:
        self._strata = Counter(map(_stratum, specs))
        first = _first_pairs(specs)
        ahead = frozenset(first)
        rest = (position for position in range(len(specs)) if position not in ahead)
        self.order = [specs[position] for position in (*first, *rest)]
        self._awaited = set(range(len(first)))
        self._seconds: dict[Stratum, list[float]] = {}
        trials = Counter(spec.cell for spec in specs)
        self.estimates = tuple(Estimate(cell, own, None) for cell, own in trials.items())

    def results(self, played: Results) -> Results:
        """The results of trials that are played in this order, as they come."""
        with closing(played):
            for position, result in played:
                if position in self._awaited:
                    self._awaited.remove(position)
                    self._hear(self.order[position], result.record)
                yield position, result

    def _hear(self, spec: TrialSpec, record: TrialRecord) -> None:
        self._seconds.setdefault(_stratum(spec), []).append(_repeated(record))
        if self._awaited:
            return
        known = {stratum: _mean(own) for stratum, own in self._seconds.items()}
        otherwise = _mean([one for own in self._seconds.values() for one in own])
        seconds = dict.fromkeys((own.cell for own in self.estimates), 0.0)
        for stratum, number in self._strata.items():
            seconds[stratum[0]] += number * known.get(stratum, otherwise)
        self.estimates = tuple(own._replace(seconds=seconds[own.cell]) for own in self.estimates)


def _first_pairs(specs: Sequence[TrialSpec]) -> list[int]:
    """The positions of the first pair of each stratum, or of at most `MOST` of them."""
    first: dict[Stratum, str] = {}
    for spec in specs:
        first.setdefault(_stratum(spec), spec.pair)
    chosen = dict(list(first.items())[:: -(-len(first) // MOST)])
    return [at for at, spec in enumerate(specs) if chosen.get(_stratum(spec)) == spec.pair]


def _stratum(spec: TrialSpec) -> Stratum:
    return spec.cell, spec.scenario, spec.level


def _repeated(record: TrialRecord) -> float:
    """The seconds of a trial without what the next ones reuse."""
    return max(0.0, record.wall_time_s - record.preparation_cpu_s)


def _mean(values: Sequence[float]) -> float:
    return sum(values) / len(values)
