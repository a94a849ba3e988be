"""What a robot expects of each step, where actions may have several outcomes."""

from collections.abc import Iterator
from copy import copy

from agents.shared.reasoning import sessions_of
from asp.reasoning import Goal, Knowledge, satisfied
from asp.reasoning.diagnosis import Explanation, Happening, History, record_of
from asp.reasoning.planning import Plan
from asp.solving import State

Layer = dict[State, list[State]]
"""States of a step, each with those of the next step that may follow it."""


class Expectations:
    """The states that a robot believed in, or expected, one for each step since its first decision.

    Of several outcomes of an action that one is expected from which the rest of the plan may
    succeed, the first in the order of the fluents.
    """

    def __init__(self, knowledge: Knowledge, goal: Goal) -> None:
        sessions = sessions_of(knowledge)
        self._knowledge = knowledge
        self._goal = goal
        self._plans = sessions.plans
        self._transitions = sessions.transitions
        self._tracker = sessions.diagnosis.tracker(goal)
        self._ahead: Plan = ()
        self.states: dict[int, State] = {}
        """By step; empty before the first decision."""

    def copy(self) -> "Expectations":
        """The same, of a history that may go on otherwise."""
        other = copy(self)
        other.states = self.states.copy()
        return other

    def believe(self, step: int, state: State, ahead: Plan) -> None:
        """The robot believes in a state and has this plan ahead."""
        self.states[step], self._ahead = state, ahead

    def forget(self) -> None:
        """The history is explained otherwise: what was expected says nothing of outcomes."""
        self.states = {}

    def follow(self, history: History, adopted: Explanation) -> bool:
        """Expects states up to the history's step; whether something observed contradicts them.

        What was observed before the last decision is not compared again. Raises LimitError.
        """
        step, is_contradicted = max(self.states, default=history.step), False
        while self.states:
            state = self.states[step]
            is_contradicted |= bool(self._tracker.surprises(history.at(step), state))
            if step == history.step:
                break
            states = list(self._after(history, adopted, step, state))
            if not states:  # what was attempted came out as it cannot in this state
                return True
            executed = adopted.executed(record_of(history.at(step), self._knowledge), step)
            if executed is not None and self._ahead[:1] == (executed,):
                self._ahead = self._ahead[1:]
            step += 1
            self.states[step] = self._best(states)
        return is_contradicted

    def other_outcome(self, history: History, adopted: Explanation) -> Happening | None:
        """The first action whose outcome was another than expected, by what was observed since.

        What is expected becomes a course of states that agrees with everything. None where there is
        no such course from the first state on. Raises LimitError.
        """
        first, expected = min(self.states), self.states
        layers = self._layers(history, adopted, first)
        possible = set(layers[-1])
        kept = [possible]
        for layer in layers[-2::-1]:
            possible = {state for state, after in layer.items() if possible.intersection(after)}
            kept.append(possible)
        kept.reverse()
        if not kept[0]:
            self.forget()
            return None
        steps = range(first + 1, history.step + 1)
        wrong = next(step for step in steps if expected.get(step) not in kept[step - first])
        self.states = self._course(layers, kept, first)
        record = record_of(history.at(wrong - 1), self._knowledge)
        executed = adopted.executed(record, wrong - 1)
        actions = adopted.happened(record, wrong - 1) if executed is None else (executed,)
        return Happening(wrong - 1, actions[0]) if actions else None

    def _layers(self, history: History, adopted: Explanation, first: int) -> list[Layer]:
        """The states of each step from one on that agree with what was observed up to it."""
        layers: list[Layer] = [{self.states[first]: []}]
        for step in range(first, history.step + 1):
            moment, layer = history.at(step), layers[-1]
            layer = {s: [] for s in layer if not self._tracker.surprises(moment, s)}
            layers[-1] = layer
            if step < history.step:
                for state in layer:
                    layer[state] = list(self._after(history, adopted, step, state))
                layers.append({after: [] for some in layer.values() for after in some})
        return layers

    def _course(self, layers: list[Layer], kept: list[set[State]], first: int) -> dict[int, State]:
        """A course of states that are kept, by step, from the first on."""
        course = {first: self.states[first]}
        for step, layer in enumerate(layers[:-1], start=first):
            after = (state for state in layer[course[step]] if state in kept[step + 1 - first])
            course[step + 1] = next(after)
        return course

    def _after(
        self, history: History, adopted: Explanation, step: int, state: State
    ) -> Iterator[State]:
        """The states that may follow one, if what happened there agrees with the explanation."""
        record = record_of(history.at(step), self._knowledge)
        executed, events = adopted.executed(record, step), adopted.happened(record, step)
        states, took_effect = self._transitions.all_after(state, executed, events)
        if record.attempt is None or record.attempt[1] == took_effect:
            yield from states

    def _best(self, states: list[State]) -> State:
        if len(states) == 1:
            return states[0]
        if not self._ahead:
            return next((s for s in states if satisfied(self._goal, s)), states[0])
        succeeds = self._plans.succeeds
        return next((s for s in states if succeeds(s, self._goal, self._ahead)), states[0])
