"""Both diagnosers against every set of events, in histories that are told at once or grow."""

from collections.abc import Sequence

from asp import Step
from asp.reasoning.diagnosis import (
    DiagnosisSessions,
    Explanation,
    History,
    InconsistentHistoryError,
    IncrementalDiagnoser,
    ReferenceDiagnoser,
)
from benchmarks.descriptions.case import Case, agree
from benchmarks.descriptions.definition import Goal, State
from benchmarks.descriptions.drawing import random_goal
from benchmarks.descriptions.explaining import Explaining
from benchmarks.descriptions.lived import Life, lived

_HISTORIES, _MOST_EVENTS = 3, 2


def check_explanations(case: Case) -> None:
    """All smallest explanations of histories that are told at once, and which is the first."""
    for _ in range(_HISTORIES):
        goal = random_goal(case.description, case.random)
        _check_told(case, lived(case.definition, case.random, goal).told, goal)


def _check_told(case: Case, history: Sequence[Step], goal: Goal) -> None:
    what = f"explain {history} with the goal {goal}"
    smallest = Explaining(case.definition, goal).smallest(history, _MOST_EVENTS)
    if smallest is None:
        return
    try:
        first = case.domain.explain(history, goal)
    except InconsistentHistoryError:
        agree(what, definition=smallest, incremental=[])
        return
    agree(what, definition=smallest != [], incremental=True)
    firsts = {"definition": smallest[0], "incremental": first}
    agree(what, **{side: one.without_start for side, one in firsts.items()})
    agree(f"{what}: the start", **{s: _starts(case, history, one) for s, one in firsts.items()})
    every, more = case.domain.explanations(history, goal, most=10_000)
    assumed = [*map(_assumed, every)]
    agree(what, definition={*map(_assumed, smallest)}, incremental={*assumed})
    agree(f"{what}: each once, no more", found=(len(assumed), more), sets=(len({*assumed}), False))


def _starts(case: Case, history: Sequence[Step], explanation: Explanation) -> list[State]:
    """The initial states with what was observed and what is assumed of them."""
    literals = {*history[0].observed, *explanation.initial}
    return [
        state for state in case.definition.initial if case.definition.satisfies(state, literals)
    ]


def _assumed(explanation: Explanation) -> tuple[object, ...]:
    """What alternatives differ in."""
    return explanation.unobserved, explanation.distrusted, explanation.exceptions


def check_histories(case: Case) -> None:
    """What is adopted while a history grows and news of it come late, by both diagnosers."""
    for _ in range(_HISTORIES):
        _Twins(case).follow(lived(case.definition, case.random))


class _Twins:
    """The reference and its incremental twin, and what both have adopted."""

    def __init__(self, case: Case) -> None:
        sessions = DiagnosisSessions(case.knowledge)
        self._reference = ReferenceDiagnoser[History](case.knowledge, ())
        self._incremental = IncrementalDiagnoser(sessions, (), 0, self._reference)
        self._explaining = Explaining(case.definition)

    def follow(self, life: Life) -> None:
        """Diagnoses the history step after step, as long as something explains it."""
        adopted: Explanation | None = Explanation()
        for history, steps in life.growing():
            if adopted is None:
                return
            what, before = f"explain {steps} after {adopted}", adopted.left(history)
            ours = self._adopted(self._incremental, history, adopted)
            theirs = self._adopted(self._reference, history, adopted)
            agree(what, incremental=ours, reference=theirs)
            smallest = self._explaining.smallest(steps, _MOST_EVENTS)
            if smallest is not None:
                agree(what, definition=_next(smallest, before), incremental=ours)
            adopted = ours

    @staticmethod
    def _adopted(
        diagnoser: IncrementalDiagnoser[History] | ReferenceDiagnoser[History],
        history: History,
        adopted: Explanation,
    ) -> Explanation | None:
        """The next explanation; None where nothing explains the history."""
        try:
            return diagnoser.diagnose(history, adopted).explanation
        except InconsistentHistoryError:
            return None


def _next(smallest: Sequence[Explanation], before: Explanation) -> Explanation | None:
    """What is adopted next: what was, if it is still as small as any, else the first of all."""
    if before in smallest:
        return before
    kept = [one for one in smallest if one.without_start == before.without_start]
    return next(iter([*kept, *smallest]), None)
