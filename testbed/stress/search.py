"""The order of a search: every case with one event, then what is most promising, and draws.

What comes next follows from the results so far, which are heard in the order in which their units
were given out: the order is the same for any number of processes, and when a search is resumed.
"""

from collections import deque
from collections.abc import Callable, Iterator, Mapping, Sequence
from concurrent.futures import Executor, Future
from itertools import count

from testbed.config import ExperimentConfig
from testbed.experiment.seeds import generator_of
from testbed.experiment.specs import TrialSpec
from testbed.stress.cases import drawn_case
from testbed.stress.frontier import Frontier
from testbed.stress.units import Branching, Drawing, Result, Unit, play

AHEAD = 8
"""Units that are given out before the result of the first of them is heard."""


class Search:
    """Gives out units, and hears what came of them.

    First every case with no and with one event, in an order drawn with the seed of the
    configuration. Then, up to `stress.events`, what is behind the episodes that nothing was found
    in: where events have a rate the likeliest first (uniform-cost search), else of each case in
    turn that of the greatest score. Every other unit is then a draw, where `stress.vary` lists what
    is drawn, or several events may happen.
    """

    def __init__(self, config: ExperimentConfig, cases: Sequence[TrialSpec]) -> None:
        self.settings = config.stress
        self._config = config
        order = generator_of(config.seed, "stress").permutation(len(cases))
        self._cases = [cases[int(number)] for number in order]
        self._first = deque(self._cases)
        self._exploring = self._unheard = 0  # units given out whose results are not heard
        self._open, self._drawings = Frontier(), count()
        self._draws = bool(self.settings.vary) or self.settings.events > 1
        self._turn = False

    def next(self) -> Unit | None:
        """The next unit; None where none is left, or what is next depends on results."""
        if self._first:
            self._exploring += 1
            return Branching(self._first.popleft(), ())
        if self._exploring:  # the most promising is known when all cases are explored
            return None
        self._turn = not self._turn
        if self._open and (self._turn or not self._draws):
            self._unheard += 1
            case, found = self._open.pop()
            return Branching(case, found.events)
        left = self.settings.vary or self._open or self._unheard
        return self._drawing() if self._draws and left else None

    def hear(self, unit: Unit, result: Result) -> None:
        """Learn what came of a unit, in the order in which units were given out."""
        if isinstance(unit, Drawing):
            return
        if unit.events:
            self._unheard -= 1
        else:
            self._exploring -= 1
        for own in result.judged[1:]:
            if not own.findings and len(own.events) < self.settings.events:
                self._open.push(unit.case, own)

    def _drawing(self) -> Drawing:
        number = next(self._drawings)
        draw = generator_of(self._config.seed, ["stress", number])
        case = self._cases[int(draw.integers(len(self._cases)))]
        events = int(draw.integers(1, self.settings.events + 1))
        return Drawing(drawn_case(self._config, case, draw), events, number)


def results(
    search: Search, executor: Executor, known: Mapping[str, Result], goes_on: Callable[[], bool]
) -> Iterator[tuple[Unit, Result]]:
    """Units with their results, in the order in which they were given out.

    `known` are results of an earlier search, by the id of the unit. No unit is given out once
    `goes_on` says no.
    """
    pending: deque[tuple[Unit, Result | Future[Result]]] = deque()
    while True:
        while len(pending) < AHEAD and goes_on() and (unit := search.next()) is not None:
            found = known.get(unit.id) or executor.submit(play, unit, search.settings)
            pending.append((unit, found))
        if not pending:
            return
        unit, found = pending.popleft()
        result = found if isinstance(found, Result) else found.result()
        search.hear(unit, result)
        yield unit, result
