"""What may have happened at one step, from one state, and what that assumes: arcs."""

from collections.abc import Collection, Sequence
from dataclasses import dataclass

from asp.language import Literal
from asp.reasoning.diagnosis.explanations import Explanation
from asp.reasoning.diagnosis.history import Happening, Problem, Record
from asp.reasoning.diagnosis.smallest_explanations import SmallestExplanations
from asp.reasoning.knowledge import Knowledge
from asp.solving import Recent, State

REMEMBERED = 4_000
"""Of how many states and records the arcs are remembered."""

MOST_COUNTED = 64
"""How many events and distrusted reports of one step are counted at most."""

_MOST_STATES = 10_000
_ATTEMPT, _END, _REPORT = range(3)
_LAST = float("inf")

Place = tuple[object, ...]
"""A place in an order, compared with places of the same kind only."""


@dataclass(frozen=True)
class Step:
    """What is known of one step: what happened, and what was seen a step later.

    Where it is not `is_past`, no event is assumed.
    """

    happened: Record
    is_past: bool
    seen: tuple[Literal, ...] = ()


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
        # Every event of a step, and its attempt, may have to be assumed or distrusted.
        self.counted = min(len(events) + 1, MOST_COUNTED)
        """How many events and distrusted reports of one step are counted."""
        self.most_assumed = float("inf") if len(events) < MOST_COUNTED else MOST_COUNTED
        """The greatest size of explanations of one step up to which none is left out."""

    def of(self, state: State, step: Step, room: int, most: int) -> Sequence[Arc] | None:
        """The arcs of a state whose explanations have at most the size `room`.

        None where they are more than `most`, and where one explanation leads to several states: the
        order does not say to which. Raises LimitError.
        """
        return self._found.get(
            (state, step, room, most), lambda: self._look(state, step, room, most)
        )

    def _look(self, state: State, step: Step, room: int, most: int) -> Sequence[Arc] | None:
        records = {0: step.happened, 1: Record(observed=step.seen)}
        problem = Problem((), records, step=1, since=0 if step.is_past else 1)
        question = self._steps.outcomes(problem, self.counted).starting(state)
        found, left_off = question.all(room, None, most)
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
