"""Episodes that are worth more events, and which of them is next."""

from collections import Counter
from heapq import heappop, heappush
from itertools import count
from typing import NamedTuple

from testbed.experiment.specs import TrialSpec
from testbed.stress.units import Judged

ALL = ""
"""The group of all cases, where episodes have probabilities, which compare across cases."""


class Open(NamedTuple):
    """An episode of a case. The order of tuples is that of a queue: `number` is unique."""

    minus_worth: float
    number: int
    case: TrialSpec
    judged: Judged


class Frontier:
    """A queue per case, which take turns; a single one where episodes have probabilities.

    Scores of different cases say little about each other: by them alone a search would stay in the
    case with the longest episodes. Of the queues that were used least, the one with the best head
    is next.
    """

    def __init__(self) -> None:
        self._queues: dict[str, list[Open]] = {}
        self._used: Counter[str] = Counter()
        self._numbers = count()

    def __bool__(self) -> bool:
        return bool(self._queues)

    def push(self, case: TrialSpec, judged: Judged) -> None:
        """Add an episode: the likelier, or else the greater its score, the sooner it is next."""
        group, worth = case.trial, judged.score
        if judged.chance is not None:
            group, worth = ALL, judged.chance
        queue = self._queues.setdefault(group, [])
        heappush(queue, Open(-worth, next(self._numbers), case, judged))

    def pop(self) -> tuple[TrialSpec, Judged]:
        """Take out the next episode. Raises ValueError where there is none."""
        group = min(self._queues, key=lambda own: (self._used[own], self._queues[own][0][:2]))
        self._used[group] += 1
        found = heappop(self._queues[group])
        if not self._queues[group]:
            del self._queues[group]
        return found.case, found.judged
