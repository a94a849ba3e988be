"""One abstract action carried out: zoom, plan, act, test each outcome, search, plan again."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from copy import copy

from agents.intentional.abstraction import AbstractTask
from agents.intentional.executor.belief import FineTracker
from agents.intentional.executor.sensing import Asking, Sensing
from agents.intentional.executor.zoomed_planning import ZoomedPlanner
from asp.language import Action, Literal
from asp.refinement import Transition
from asp.solving import LimitError, State, deciding
from testbed.protocol import WAIT

_PATIENCE = 12
"""So many failures in a row are not taken for bad luck any more."""


class Execution:
    """How the transition of one abstract action is brought about.

    `effects` are the coarse literals that the action is to bring about. When `run` is over,
    `happened` says whether it did; one that did not need not have been impossible.
    """

    def __init__(
        self, fine: FineTracker, coarse: AbstractTask, action: Action, before: State, step: int
    ) -> None:
        """`before` is the coarse state that the action is to lead from."""
        self._fine = fine
        self.action = action
        after = coarse.after(before, action, ())
        assert after is not None, "a robot attempts what it believes to be possible"
        transition = self._transition = Transition(before, action, after)
        self._planner = ZoomedPlanner(fine, transition, coarse.inertial)
        self.effects = self._planner.effects
        self.happened = False
        with fine.trace.timing("planning"):
            self._direct = fine.model.direct_effects[action]
            self._things = fine.looked_for(self._planner.relevant)
        self._sensing = Sensing(fine, transition, self._things)
        every = fine.refinement.coarse_signature.constants
        zoomed = self._planner.relevant if fine.zooms else every
        fine.trace.note(abstract=action, begun=step, zoomed=sorted(zoomed))
        self._failures = self._in_vain = 0

    def anew(self, fine: FineTracker) -> Execution:
        """The same from its beginning, with a tracker; plans that were found are known."""
        other = copy(self)
        other._fine, other._planner = fine, self._planner.anew(fine)
        other._sensing = Sensing(fine, self._transition, self._things)
        other.happened, other._failures, other._in_vain = False, 0, 0
        return other

    def run(self) -> Asking[None]:
        """Carries the action out, as far as that can be done."""
        yield from self._sensing.look()
        while max(self._failures, self._in_vain) < _PATIENCE:
            plan = yield from self._planned()
            if plan:
                self._in_vain += yield from self._follow(plan)
            self.happened = plan is not None and self._is_settled()
            if self.happened or not plan:
                return
        self._fine.trace.note(failed=f"{self.action} failed {_PATIENCE} times in a row")

    def _follow(self, plan: Sequence[Action]) -> Asking[bool]:
        """Does one action after another, as long as nothing upsets the plan."""
        for number, action in enumerate(plan, start=1):
            self._sensing.clear()
            done = yield from self._do(action)
            self._failures = 0 if done else self._failures + 1
            if not done or self._is_upset(plan[number:]):
                return False
        return True

    def _do(self, action: Action) -> Asking[bool]:
        """Attempts a concrete action and tests what came of it; then looks around, or why not."""
        expected = self._fine.effects.of(action, self._fine.true)
        self._fine.trace.add("actions")
        self._fine.pending = expected
        percept = yield action
        self._sensing.hear(percept)
        outcome: list[Literal] = []
        for effect in expected:
            came_out = yield from self._sensing.outcome(effect, percept)
            outcome += [] if came_out is None else [came_out]
        self._fine.pending = ()
        self._fine.assume(outcome)
        self._sensing.commit(each for each in outcome if self._fine.test_of(each) is not None)
        if outcome == list(expected):
            yield from self._sensing.look()
            return True
        missing = (effect for effect in expected if effect not in outcome)
        self._fine.trace.note(failed=f"{action}: not {', '.join(missing)}")
        yield from self._sensing.doubt(action)
        return False

    def _planned(self) -> Asking[tuple[Literal, ...] | None]:
        """A plan; where a decision reaches one of its limits the robot waits, and goes on after."""
        while True:
            try:
                with deciding(self._fine.limits):
                    return self._planner.plan()
            except LimitError as limit:
                self._fine.trace.note(failed=str(limit))
                self._sensing.hear((yield WAIT))

    def _is_settled(self) -> bool:
        """Whether the action is done; then what nobody can see of its effects is believed, too.

        Its effects follow from what is known then. Of fluents without counterparts an indirect
        effect follows unless the contrary is shown.
        """
        fine = self._fine
        with fine.trace.timing("infer"):
            holding = fine.holding(self.effects)
        done = all(
            effect in holding
            or not (
                fine.is_magnified(effect)
                or effect in self._direct
                or effect.complement in fine.shown
            )
            for effect in self.effects
        )
        if done:
            fine.assume(self.effects)
        return done

    def _is_upset(self, rest: Sequence[Literal]) -> bool:
        """Whether something new is about what the rest of a plan acts upon.

        A thing that is found where it is acted upon next was expected there, and one that is not
        found elsewhere was not.
        """
        if not rest:
            return False
        about, next_to_hand = self._wholes(rest), self._wholes(rest[:1])
        if not self._sensing.heard.isdisjoint(about):
            return True
        return any(
            whole in about and literal.is_positive != (whole in next_to_hand)
            for literal in self._sensing.seen
            for whole in self._wholes([literal]) & self._sensing.looked_for
        )

    def _wholes(self, literals: Iterable[Literal]) -> set[str]:
        """The coarse constants that literals or actions are about, the robot apart."""
        wholes = self._fine.refinement.wholes
        named = {wholes.get(c, c) for literal in literals for c in literal.arguments}
        return named - {self._fine.robot}
