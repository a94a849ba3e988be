"""Zoomed planning: concrete actions for an abstract one, in the part of D_f that is relevant."""

from __future__ import annotations

from collections import deque
from collections.abc import Collection, Sequence
from copy import copy

from agents.intentional.executor.belief import FineTracker
from asp.language import Action, Fluent, Literal
from asp.reasoning.fine_planning import FineStart, NoPlan
from asp.refinement import Transition, fine_constants, fine_goal, relevant
from asp.solving import LimitError

Groups = tuple[tuple[Literal, ...], ...]
"""Groups of fluents one of each of which is true."""
Found = tuple[Action, ...] | LimitError | None
"""A plan, the limit that was reached before there was one, or None: there is none."""


class ZoomedPlanner:
    """Plans for one abstract action; `effects` are the coarse literals that it is to bring about.

    `relevant` are the coarse constants that bear on the action or the goal.
    """

    def __init__(
        self, fine: FineTracker, transition: Transition, inertial: Collection[Fluent]
    ) -> None:
        """`transition` is to be brought about, `inertial` are the coarse inertial fluents."""
        self._fine = fine
        self._action = transition.action
        self._inertial = transition.before.intersection(inertial)
        self._found: list[Found] = []
        self._known: deque[Found] = deque()
        with fine.trace.timing("planning"):
            self.relevant = relevant(fine.refinement, transition, fine.goal)
            self.effects, self._lasting = fine_goal(fine.refinement, transition, self.relevant)

    def anew(self, fine: FineTracker) -> ZoomedPlanner:
        """One that first gives the plans that this one gave, and then goes on with a tracker."""
        other = copy(self)
        other._fine, other._found = fine, []
        other._known = deque((*self._found, *self._known))
        return other

    def plan(self) -> tuple[Action, ...] | None:
        """A shortest plan for the effects; None if nothing in the zoomed domain leads to them.

        What else is so, and is not to change, is part of the goal where the plan would change it;
        unless there is no other. Raises LimitError.
        """
        found = self._known.popleft() if self._known else self._limited()
        self._found.append(found)
        if isinstance(found, LimitError):
            raise found
        return found

    def _limited(self) -> Found:
        try:
            return self._plan()
        except LimitError as limit:
            return limit

    def _plan(self) -> tuple[Action, ...] | None:
        with self._fine.trace.timing("planning"):
            candidates = self._candidates()
            if not all(candidates):
                return None
            plan = shortest_plan(self._fine, self.effects, candidates, self.relevant)
            if plan and (lasting := self._spoilt(plan)):
                goal = (*self.effects, *lasting)
                plan = shortest_plan(self._fine, goal, candidates, self.relevant) or plan
        if plan:
            self._fine.trace.add("plans")
            self._fine.trace.note(plan=list(plan))
        return plan

    def _spoilt(self, plan: Sequence[Action]) -> tuple[Literal, ...]:
        """What is known to hold and is not to change, if a plan has effects contrary to it."""
        fine = self._fine
        effects = (effect for action in plan for effect in fine.effects.of(action, fine.true))
        changed = {coarse for effect in effects for coarse in fine.refinement.coarse_of(effect)}
        if changed.isdisjoint(each.complement for each in self._lasting):
            return ()
        return tuple(fine.holding(self._lasting))

    def _candidates(self) -> tuple[tuple[Fluent, ...], ...]:
        """Where the things that the action is about, or tied to, may be by the coarse belief.

        A fluent that is known to be false by now stands in the way of an action that depends on it,
        and of no other: to go to a room a robot need not find there what it expected.
        """
        about = self._about()
        needed = self._fine.model.conditions[self._action]
        return tuple(
            group
            for fluent in sorted(self._inertial)
            if self._fine.is_magnified(fluent) and not about.isdisjoint(fluent.arguments)
            for group in self._fine.belief.candidates(fluent)
            if group or fluent in needed
        )

    def _about(self) -> frozenset[str]:
        """The constants of the action, and those related to them otherwise than by place."""
        about = set(self._action.arguments)
        ties = [set(f.arguments) for f in self._inertial if not self._fine.is_value(f)]
        while further := [tie for tie in ties if not about.isdisjoint(tie) and not tie <= about]:
            about.update(*further)
        return frozenset(about)


def shortest_plan(
    fine: FineTracker, goal: tuple[Literal, ...], candidates: Groups, zoom: Collection[str]
) -> tuple[Action, ...] | None:
    """A shortest plan of concrete actions; None if there is none. Raises LimitError.

    By Definition 1 the place of the robot need not be relevant to what it does there; a state has
    to say where it is all the same.
    """
    refinement, model = fine.refinement, fine.model
    # Of fluents without counterparts a state is told by inertial ones: others follow by laws.
    symbols = refinement.coarse_signature.symbols
    inertial = frozenset(f for f in fine.unmagnified if symbols[f.name].kind == "inertial")
    true = fine.belief.known.true | inertial
    own = (fluent.arguments for fluent in true if fine.robot in fluent.arguments)
    whereabouts = (refinement.wholes.get(each, each) for named in own for each in named)
    zoom = frozenset(zoom).union(whereabouts)
    constants = zoom | fine_constants(refinement, zoom)
    # What need not have a value is assumed to hold of the first component of which it may.
    assumed = {group[0] for group in candidates if not model.is_value(group[0])}
    values = tuple(group for group in candidates if group[0] not in assumed)
    start = FineStart(true | assumed, values)
    limit = sum(len(refinement.components[constant]) for constant in zoom) + 1
    found = model.planner.plan(start, goal, limit, constants if fine.zooms else None)
    return None if isinstance(found, NoPlan) else found
