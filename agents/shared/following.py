"""What an explanation of a history says of each step: one state after another."""

from __future__ import annotations

from dataclasses import dataclass

from agents.shared.assuming import executed_under, happened_under
from agents.shared.history import GOAL, Diagnosis, History, Moment
from agents.shared.knowledge import Knowledge
from agents.shared.memory import record_of
from agents.shared.sessions import tools_of
from asp.language import atom, is_positive
from asp.solving import State


@dataclass(frozen=True)
class Belief:
    """What the adopted history says of a step, and the steps up to it at which the goal held."""

    step: int
    state: State
    held: frozenset[int]


class Follower:
    """Carries beliefs about one goal forward, `since` being the first step with events."""

    def __init__(self, knowledge: Knowledge, goal: tuple[str, ...], since: int) -> None:
        self._knowledge = knowledge
        self._transitions = tools_of(knowledge).transitions
        self._goal = goal
        self._since = since

    def holds(self, state: State) -> bool:
        """Whether the goal does."""
        return all((atom(literal) in state) == is_positive(literal) for literal in self._goal)

    def start(self, state: State) -> Belief:
        """The belief at step 0."""
        return Belief(0, state, frozenset([0]) if self.holds(state) else frozenset())

    def carried(self, belief: Belief, history: History, adopted: Diagnosis) -> Belief | None:
        """The belief at the history's step; None where the explanation does not agree with it.

        Raises LimitError.
        """
        later: Belief | None = belief
        while later is not None and self._agrees(history.at(later.step), later.state):
            if later.step == history.step:
                return later
            later = self._advance(later, history, adopted)
        return None

    def replayed(self, belief: Belief, history: History, adopted: Diagnosis) -> Belief:
        """The belief at the history's step under an explanation that agrees with it."""
        while belief.step < history.step:
            after = self._advance(belief, history, adopted)
            assert after is not None, "an explanation explains every step"
            belief = after
        return belief

    def _advance(self, belief: Belief, history: History, adopted: Diagnosis) -> Belief | None:
        """The belief a step later, if what happened there agrees with the explanation."""
        step = belief.step
        record = record_of(self._knowledge, history.at(step))
        attempt = executed_under(record, adopted, step)
        events = happened_under(record, adopted, step)
        if events and step < self._since:
            return None
        after = self._transitions.after(belief.state, attempt, events)
        if after is None or (record.attempt is not None and record.attempt[1] != after[1]):
            return None
        return self._next(belief, after[0])

    def _next(self, belief: Belief, state: State) -> Belief:
        step = belief.step + 1
        return Belief(step, state, belief.held | {step} if self.holds(state) else belief.held)

    def _agrees(self, moment: Moment, state: State) -> bool:
        """Whether what was observed at a moment is so in the state."""
        return all(
            truth == (self.holds(state) if fluent == GOAL else fluent in state)
            for fluent, truth in moment.trusted.items()
        )
