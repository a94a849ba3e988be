"""What may have happened at one step, from one state, and what that assumes: arcs."""

from collections.abc import Collection, Sequence
from dataclasses import dataclass

from asp.reasoning.diagnosis.explanations import Explanation
from asp.reasoning.diagnosis.history import Happening, Problem, Record
from asp.reasoning.diagnosis.smallest_explanations import MANY, SmallestExplanations
from asp.reasoning.knowledge import Knowledge
from asp.solving import Recent, State

REMEMBERED = 4_000
"""Of how many states and records the arcs are remembered."""

_MOST_STATES = 10_000
_ATTEMPT, _END, _REPORT = range(3)
_LAST = float("inf")

Place = tuple[object, ...]
"""A place in an order, compared with places of the same kind only."""


@dataclass(frozen=True, slots=True)
class Arc:
    """An explanation of one step, and the state that it leads to.

    `distrusted` and `assumed` are its places in the order that `order.lp` states, by what it
    distrusts and by the events that it assumes; the earlier is preferred.
    """

    explanation: Explanation
    after: State
    size: int
    distrusted: Place
    assumed: Place


class Arcs:
    """The arcs of a domain, found by the solver and remembered whatever the history."""

    def __init__(self, knowledge: Knowledge) -> None:
        self._steps = SmallestExplanations(knowledge, begins=False)
        events = knowledge.description.exogenous_actions
        self._places = {event: place for place, event in enumerate(events)}
        self._found: Recent[object, Sequence[Arc] | None] = Recent(REMEMBERED)
        self._states: Recent[State, State] = Recent(_MOST_STATES)
        self.most_assumed = float("inf") if len(events) < MANY else MANY
        """The greatest size of explanations of one step up to which none is left out."""

    def of(
        self, state: State, record: Record, is_past: bool, room: int, most: int
    ) -> Sequence[Arc] | None:
        """The arcs of a state whose explanations have at most the size `room`.

        None where they are more than `most`, and where one explanation leads to several states: the
        order does not say to which. At a step that is not `is_past` no event is assumed. Raises
        LimitError.
        """
        return self._found.get(
            (state, record, is_past, room, most),
            lambda: self._look(state, record, is_past, room, most),
        )

    def _look(
        self, state: State, record: Record, is_past: bool, room: int, most: int
    ) -> Sequence[Arc] | None:
        problem = Problem((), {0: record}, step=1, since=0 if is_past else 1)
        found, left_off = self._steps.outcomes(problem).starting(state).all(room, None, most)
        several = len({explanation for explanation, _ in found}) < len(found)
        return None if left_off or several else [self._arc(*each) for each in found]

    def _arc(self, explanation: Explanation, after: State) -> Arc:
        distrusted = (
            (_ATTEMPT, 0) if place < 0 else (_REPORT, -place)
            for place in self._in_order(explanation.distrusted)
        )
        return Arc(
            explanation,
            self._states.get(after, lambda: after),
            explanation.size,
            (*distrusted, (_END, 0)),
            (*self._in_order(explanation.unobserved), _LAST),
        )

    def _in_order(self, happenings: Collection[Happening]) -> list[int]:
        """The places of actions in the order of declaration; an attempt comes before the first."""
        return sorted(self._places.get(action, -1) for _, action in happenings)
