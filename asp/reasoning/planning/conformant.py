"""Conformant plans: they reach the goal whatever outcomes their actions have.

A plan is conformant for some states if each of its actions is possible in every state that may be
reached by then, and every state that may be reached in the end satisfies the goal. Shortest ones
are looked for breadth first, over the sets of states that a plan may have led to.
"""

from collections.abc import Callable, Collection, Iterable, Sequence
from functools import cache
from typing import Literal, TypeAlias

from asp.language import Action
from asp.reasoning.knowledge import Goal, Knowledge, satisfied
from asp.reasoning.planning.incremental import IncrementalPlanner
from asp.reasoning.planning.reference import Plan
from asp.reasoning.successors import Transitions
from asp.solving import Answers, State, answer_sets, current, fact, ground, state_of

Plans: TypeAlias = Literal["optimistic", "conformant"]
"""Whether some outcomes of a plan's actions reach its goal, or all do."""

Outcomes: TypeAlias = Callable[[State, Action], Collection[State]]
"""The states that an action may lead to; none where it is impossible."""

MOST_OUTCOMES = 100_000
"""Of how many states and actions the outcomes are remembered."""

_ONE_STEP = """
holds(F,0)  :- inertial(F), starts(F).
-holds(F,0) :- inertial(F), not starts(F).
next(F) :- holds(F,1).
#show next/1.
#defined starts/1.
"""


class ConformantPlanner:
    """Shortest conformant plans of some actions, by their outcomes."""

    def __init__(self, actions: Sequence[Action], outcomes: Outcomes) -> None:
        self._actions = actions
        self._outcomes = outcomes

    def shortest(self, states: Iterable[State], goal: Goal, limit: int) -> Plan | None:
        """The first of the shortest plans of at most `limit` actions, or None.

        Earlier actions count before later ones, at one step the action declared first. The goal
        does not hold in all of the states. Raises LimitError.
        """
        start = frozenset(states)
        reached, layer = {start}, [(start, Plan())]
        for _ in range(limit):
            following = []
            for before, plan in layer:
                for action in self._actions:
                    after = self._after(before, action)
                    if after and after not in reached:
                        if all(satisfied(goal, state) for state in after):
                            return (*plan, action)
                        reached.add(after)
                        following.append((after, (*plan, action)))
            layer = following
        return None

    def succeeds(self, states: Iterable[State], goal: Goal, plan: Plan) -> bool:
        """Whether after some of the plan's actions the goal holds in all states; as in (36)."""
        reached = frozenset(states)
        for action in plan:
            reached = self._after(reached, action)
            if not reached:
                return False
            if all(satisfied(goal, state) for state in reached):
                return True
        return False

    def _after(self, states: frozenset[State], action: Action) -> frozenset[State]:
        """The states that an action may lead to; none where it is impossible in one of these."""
        current().take_expansions(len(states))
        found: set[State] = set()
        for state in states:
            outcomes = self._outcomes(state, action)
            if not outcomes:
                return frozenset()
            found.update(outcomes)
        return frozenset(found)


def reference_conformant_planner(knowledge: Knowledge) -> ConformantPlanner:
    """A planner that finds every outcome from scratch; what the other one is held equal to."""

    @cache  # a search comes to one state by many plans
    def outcomes(state: State, action: Action) -> Collection[State]:
        facts = [fact("occurs", action, 0), *(fact("starts", fluent) for fluent in sorted(state))]
        found, _ = answer_sets(ground([knowledge.program, _ONE_STEP], {"n": 1}, facts))
        return {state_of(shown) for shown in found}

    return ConformantPlanner(knowledge.description.agent_actions, outcomes)


class IncrementalConformantPlanner(ConformantPlanner):
    """The same with outcomes that are remembered, where a shortest plan may reach the goal at all.

    Where every action has one outcome, and there is one state, plans are those of `plans`.
    """

    def __init__(
        self, actions: Sequence[Action], transitions: Transitions, plans: IncrementalPlanner
    ) -> None:
        remembered: Answers[tuple[State, Action], Collection[State]] = Answers(MOST_OUTCOMES)

        def outcomes(state: State, action: Action) -> Collection[State]:
            def found() -> Collection[State]:
                return transitions.outcomes(state, (action,))

            return remembered.get((state, action), found)

        super().__init__(actions, outcomes)
        self._transitions = transitions
        self._plans = plans

    def shortest(self, states: Iterable[State], goal: Goal, limit: int) -> Plan | None:
        """As of any conformant planner."""
        start = frozenset(states)
        left = [state for state in start if not satisfied(goal, state)]
        alone = [self._plans.shortest(state, goal, limit) for state in left]
        if None in alone:
            return None
        if len(start) == 1 and self._transitions.deterministic:
            return alone[0]
        return super().shortest(start, goal, limit)
