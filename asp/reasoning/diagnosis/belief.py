"""The belief tracker: the states of a history by its explanation, step by step."""

from collections.abc import Sequence
from dataclasses import dataclass

from asp.language import Literal
from asp.reasoning.diagnosis.explanations import Explanation
from asp.reasoning.diagnosis.history import GOAL, History, Moment, record_of
from asp.reasoning.knowledge import Goal, Knowledge
from asp.reasoning.successors import Transitions
from asp.solving import State


@dataclass(frozen=True)
class Belief:
    """What an explained history says of a step, and the steps up to it at which the goal held."""

    step: int
    state: State
    held: frozenset[int]


class BeliefTracker:
    """Carries beliefs about one goal forward, `since` being the first step with events."""

    def __init__(
        self, knowledge: Knowledge, transitions: Transitions, goal: Goal, since: int
    ) -> None:
        self.knowledge = knowledge
        self.transitions = transitions
        self.since = since
        self.goal = goal

    def missing(self, state: State) -> list[Literal]:
        """The literals of the goal that are not true in a state."""
        return [each for each in self.goal if (each.atom in state) != each.is_positive]

    def holds(self, state: State) -> bool:
        """Whether the goal does."""
        return not self.missing(state)

    def surprises(self, moment: Moment, state: State) -> list[Literal]:
        """The literals that were observed at a moment and are not true in a state."""
        return [
            fluent if truth else fluent.complement
            for fluent, truth in moment.trusted.items()
            if truth != (self.holds(state) if fluent == GOAL else fluent in state)
        ]

    def start(self, state: State) -> Belief:
        """The belief at step 0."""
        return Belief(0, state, frozenset([0]) if self.holds(state) else frozenset())

    def along(self, states: Sequence[State]) -> list[Belief]:
        """The beliefs of steps that have these states, from step 0 on."""
        beliefs = [self.start(states[0])]
        beliefs += (self._following(beliefs[-1], state) for state in states[1:])
        return beliefs

    def carry(
        self, beliefs: list[Belief], history: History, adopted: Explanation, trusting: bool = False
    ) -> bool:
        """Adds the beliefs of all steps up to that of the history, each following the last one.

        False where the explanation does not agree with a step. Where it is `trusting`, observations
        are not compared again. Raises LimitError.
        """
        while True:
            last = beliefs[-1]
            if not trusting and self.surprises(history.at(last.step), last.state):
                return False
            if last.step == history.step:
                return True
            following = self._advance(last, history, adopted)
            if following is None:
                return False
            beliefs.append(following)

    def _advance(self, belief: Belief, history: History, adopted: Explanation) -> Belief | None:
        """The belief a step later, if what happened there agrees with the explanation."""
        step = belief.step
        record = record_of(history.at(step), self.knowledge)
        events = adopted.happened(record, step)
        if events and step < self.since:
            return None
        after = self.transitions.after(belief.state, adopted.executed(record, step), events)
        if after is None or (record.attempt is not None and record.attempt[1] != after[1]):
            return None
        return self._following(belief, after[0])

    def _following(self, belief: Belief, state: State) -> Belief:
        step = belief.step + 1
        return Belief(step, state, belief.held | {step} if self.holds(state) else belief.held)
