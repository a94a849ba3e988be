"""The belief tracker: the states of a history by its explanation, step by step."""

from collections.abc import Sequence
from dataclasses import dataclass

from asp.language import Literal
from asp.reasoning.diagnosis.explanations import Explanation
from asp.reasoning.diagnosis.history import GOAL, History, Moment, record_of
from asp.reasoning.knowledge import Goal, Knowledge, satisfied
from asp.reasoning.successors import Transitions, place_of
from asp.solving import State, current


@dataclass(frozen=True)
class Belief:
    """What an explained history may have led to at a step, and when the goal held up to it.

    Where actions have several outcomes there may be several beliefs under one explanation.
    """

    step: int
    state: State
    held: frozenset[int]


Beliefs = tuple[Belief, ...]
"""Those of one step, in the order of the fluents: first where the first of them is true."""


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
        return satisfied(self.goal, state)

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

    def along(self, states: Sequence[State]) -> list[Beliefs]:
        """The beliefs of steps that have these states, from step 0 on, one each."""
        beliefs = [self.start(states[0])]
        beliefs += (self._following(beliefs[-1], state) for state in states[1:])
        return [(belief,) for belief in beliefs]

    def carry(
        self, beliefs: list[Beliefs], history: History, adopted: Explanation, trusting: bool = False
    ) -> bool:
        """Adds the beliefs of all steps up to that of the history, each following the last ones.

        What is observed rules out beliefs of the last step. False where the explanation does not
        agree with a step. Where it is `trusting`, and every action has one outcome, observations
        are not compared again. Raises LimitError.
        """
        trusting = trusting and self.transitions.deterministic
        while True:
            last = beliefs[-1]
            if not trusting:
                moment = history.at(last[0].step)
                last = tuple(each for each in last if not self.surprises(moment, each.state))
            if not last:
                return False
            beliefs[-1] = last
            if last[0].step == history.step:
                return True
            following = self._advance(last, history, adopted)
            if not following:
                return False
            beliefs.append(following)

    def _advance(self, last: Beliefs, history: History, adopted: Explanation) -> Beliefs:
        """The beliefs a step later, if what happened there agrees with the explanation."""
        found = dict.fromkeys(
            self._following(belief, state)
            for belief in last
            for state in self._after(belief, history, adopted)
        )
        if len(found) < 2:
            return tuple(found)
        current().take_expansions(len(found))
        fluents = self.knowledge.description.fluents
        return tuple(sorted(found, key=lambda belief: place_of(belief.state, fluents)))

    def _after(self, belief: Belief, history: History, adopted: Explanation) -> Sequence[State]:
        """The states a step later, if what happened there agrees with the explanation."""
        step = belief.step
        record = record_of(history.at(step), self.knowledge)
        events = adopted.happened(record, step)
        if events and step < self.since:
            return ()
        executed = adopted.executed(record, step)
        states, took_effect = self.transitions.all_after(belief.state, executed, events)
        if record.attempt is not None and record.attempt[1] != took_effect:
            return ()
        return states

    def _following(self, belief: Belief, state: State) -> Belief:
        step = belief.step + 1
        return Belief(step, state, belief.held | {step} if self.holds(state) else belief.held)
