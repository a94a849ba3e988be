"""The order of a search: every case with one event, what is most promising, and draws.

What comes next follows from the results so far, which are heard in the order in which their units
were given out: the order is the same for any number of processes, and when a search is resumed.
"""

from collections import deque
from collections.abc import Callable, Iterator, Mapping, Sequence
from concurrent.futures import Executor, Future
from itertools import count, cycle

from testbed.config import ExperimentConfig
from testbed.experiment.seeds import generator_of
from testbed.experiment.specs import TrialSpec
from testbed.stress.cases import drawn_case
from testbed.stress.frontier import Frontier
from testbed.stress.units import Branching, Drawing, Result, Unit, play

AHEAD = 8
"""Units that are given out before the result of the first of them is heard."""
TURNS = 6
"""Of a round in which exploring, the most promising and draws take turns."""


class Search:
    """Gives out units, and hears what came of them.

    Of six turns one is for a draw, where `stress.vary` lists what is drawn or several events may
    happen, and one for what is behind an episode in which nothing was found, up to `stress.events`:
    where events have a rate the likeliest of all cases (uniform-cost search), for which all have to
    be explored; else of each case in turn that of the greatest score. Four explore: every
    case with no and with one event, in an order drawn with the seed of the configuration.
    """

    def __init__(self, config: ExperimentConfig, cases: Sequence[TrialSpec]) -> None:
        self.settings = config.stress
        self._config = config
        order = generator_of(config.seed, "stress").permutation(len(cases))
        self._cases = [cases[int(number)] for number in order]
        self._unexplored = deque(self._cases)
        self._likeliest_first = any(case.setting.rate for case in cases)
        self._exploring = self._unheard = 0  # units given out whose results are not heard
        self._open, self._drawings = Frontier(), count()
        self._draws = bool(self.settings.vary) or self.settings.events > 1
        self._turns = cycle(
            [self._case, self._case, self._best, self._case, self._case, self._draw]
        )

    def next(self) -> Unit | None:
        """The next unit; None where none is left, or what is next depends on results."""
        turns = (next(self._turns)() for _ in range(TURNS))
        return next((unit for unit in turns if unit is not None), None)

    def _case(self) -> Unit | None:
        if not self._unexplored:
            return None
        self._exploring += 1
        return Branching(self._unexplored.popleft(), ())

    def _best(self) -> Unit | None:
        if not self._open or (self._likeliest_first and (self._unexplored or self._exploring)):
            return None
        self._unheard += 1
        case, found = self._open.pop()
        return Branching(case, found.events)

    def _draw(self) -> Unit | None:
        left = self._unexplored or self._exploring or self._open or self._unheard
        return self._drawing() if self._draws and (left or self.settings.vary) else None

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

    `known` are results of an earlier search, by the id of the unit, which are not played again. No
    unit is played once `goes_on` says no.
    """
    pending: deque[tuple[Unit, Result | Future[Result]]] = deque()
    over = False
    while True:
        while not over and len(pending) < AHEAD and (unit := search.next()) is not None:
            if (found := known.get(unit.id)) is not None:
                pending.append((unit, found))
            elif goes_on():
                pending.append((unit, executor.submit(play, unit, search.settings)))
            else:
                over = True
        if not pending:
            return
        unit, given = pending.popleft()
        result = given if isinstance(given, Result) else given.result()
        search.hear(unit, result)
        yield unit, result
