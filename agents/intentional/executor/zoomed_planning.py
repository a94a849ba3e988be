"""Zoomed planning: concrete actions for an abstract one, in the part of D_f that is relevant."""

from __future__ import annotations

from collections.abc import Collection, Sequence

from agents.intentional.executor.belief import Mind
from asp.language import arguments, atom, complement, name
from asp.reasoning.fine_planning import FineStart, NoPlan
from asp.refinement import Transition, fine_constants, fine_goal, relevant

Groups = tuple[tuple[str, ...], ...]
"""Groups of fluents one of each of which is true."""


class ZoomedPlanner:
    """Plans for one abstract action; `effects` are the coarse literals that it is to bring about.

    `relevant` are the coarse constants that bear on the action or the goal.
    """

    def __init__(
        self,
        mind: Mind,
        action: str,
        before: frozenset[str],
        after: frozenset[str],
        inertial: Collection[str],
    ) -> None:
        """`before` and `after` are coarse states, `inertial` are the coarse inertial fluents."""
        self._mind = mind
        self._action = action
        self._inertial = before.intersection(inertial)
        transition = Transition(before, action, after)
        with mind.tally.timing("planning"):
            self.relevant = relevant(mind.refinement, transition, mind.goal)
            goal = fine_goal(mind.refinement, transition, self.relevant)
            self.effects = goal.effects
            self._lasting = tuple(each for each in goal.literals if each not in goal.effects)

    def plan(self) -> tuple[str, ...] | None:
        """A shortest plan for the effects; None if nothing in the zoomed domain leads to them.

        What else is so, and is not to change, is part of the goal where the plan would change it;
        unless there is no other.
        """
        mind = self._mind
        with mind.tally.timing("planning"):
            candidates = self._candidates()
            plan = self._shortest(self.effects, candidates) if all(candidates) else None
            if plan and (lasting := self._spoilt(plan)):
                goal = (*self.effects, *lasting)
                plan = self._shortest(goal, candidates) or plan
        if plan:
            mind.tally.count("plans")
            mind.tally.note(plan=list(plan))
        return plan

    def _spoilt(self, plan: Sequence[str]) -> tuple[str, ...]:
        """What is known to hold and is not to change, if a plan has effects contrary to it."""
        mind = self._mind
        true = mind.belief.known.true | mind.unmagnified
        direct = (effect for action in plan for effect in mind.effects.of(action, true))
        changed = {coarse for effect in direct for coarse in mind.refinement.coarse_of(effect)}
        if changed.isdisjoint(map(complement, self._lasting)):
            return ()
        follows = mind.belief.coarse([atom(e) for e in self._lasting if mind.is_magnified(e)])
        return tuple(
            each
            for each in self._lasting
            if (each in follows if mind.is_magnified(each) else mind.holds(each))
        )

    def _candidates(self) -> tuple[tuple[str, ...], ...]:
        """Where the things that the action is about, or tied to, may be by the coarse belief.

        A fluent that is known to be false by now stands in the way of an action that depends on it,
        and of no other: to go to a room a robot need not find there what it expected.
        """
        about = self._about()
        needed = self._mind.means.conditions.get(self._action, frozenset())
        return tuple(
            group
            for fluent in sorted(self._inertial)
            if self._mind.is_magnified(fluent) and not about.isdisjoint(arguments(fluent))
            for group in self._mind.belief.candidates(fluent)
            if group or fluent in needed
        )

    def _about(self) -> frozenset[str]:
        """The constants of the action, and those related to them otherwise than by place."""
        about = set(arguments(self._action))
        ties = [set(arguments(f)) for f in self._inertial if not self._mind.is_value(f)]
        while further := [tie for tie in ties if not about.isdisjoint(tie) and not tie <= about]:
            about.update(*further)
        return frozenset(about)

    def _shortest(self, goal: tuple[str, ...], candidates: Groups) -> tuple[str, ...] | None:
        return shortest_plan(self._mind, goal, candidates, self.relevant)


def shortest_plan(
    mind: Mind, goal: tuple[str, ...], candidates: Groups, zoom: Collection[str]
) -> tuple[str, ...] | None:
    """A shortest plan of concrete actions; None if there is none. Raises LimitError.

    By Definition 1 the place of the robot need not be relevant to what it does there; a state has
    to say where it is all the same.
    """
    refinement, means = mind.refinement, mind.means
    # Of fluents without counterparts a state is told by inertial ones: others follow by laws.
    symbols = refinement.coarse_signature.symbols
    inertial = frozenset(f for f in mind.unmagnified if symbols[name(f)].kind == "inertial")
    true = mind.belief.known.true | inertial
    own = (arguments(fluent) for fluent in true if mind.robot in arguments(fluent))
    whereabouts = (refinement.wholes.get(each, each) for named in own for each in named)
    zoom = frozenset(zoom).union(whereabouts)
    constants = zoom | fine_constants(refinement, zoom)
    # What need not have a value is assumed to hold of the first component of which it may.
    assumed = {group[0] for group in candidates if not means.is_value(group[0])}
    values = tuple(group for group in candidates if group[0] not in assumed)
    start = FineStart(true | assumed, values)
    limit = sum(len(refinement.components[constant]) for constant in zoom) + 1
    found = means.planner.plan(start, goal, limit, constants if mind.zooms else None)
    return None if isinstance(found, NoPlan) else found
