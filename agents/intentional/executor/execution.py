"""One abstract action carried out: zoom, plan, act, test each outcome, search, plan again."""

from __future__ import annotations

from collections.abc import Generator, Iterable, Sequence

from agents.intentional.executor.sensing import Looking
from agents.intentional.executor.state import Mind
from asp.language import arguments, atom, complement, is_positive
from asp.refinement import Transition, fine_goal, relevant
from asp.solving import LimitError, deciding
from testbed.protocol import Percept

Steps = Generator[str, Percept, bool]
"""Yields concrete actions, is sent the percepts after them, returns whether all went well."""

_PATIENCE = 12
"""So many failures in a row are not taken for bad luck any more."""

_WAIT = "wait"


class Execution:
    """How the transition of one abstract action is brought about.

    Its steps are yielded by `run`, which returns whether the action had its effects.
    """

    def __init__(
        self,
        mind: Mind,
        action: str,
        before: frozenset[str],
        after: frozenset[str],
        step: int,
    ) -> None:
        """`before` and `after` are the coarse states that the action is to lead from and to."""
        self._mind = mind
        self.action = action
        self._before = before
        transition = Transition(before, action, after)
        with mind.tally.planning():
            self._relevant = relevant(mind.refinement.coarse, transition, mind.goal)
            goal = fine_goal(mind.refinement, transition, self._relevant)
            self._effects = goal.effects
            self._lasting = tuple(each for each in goal.literals if each not in goal.effects)
            self._direct = mind.means.direct_effects.get(action, frozenset())
            things = mind.looked_for(self._relevant)
        self._looking = Looking(mind, before, after, things)
        every = mind.refinement.coarse_signature.constants
        mind.tally.begin(action, step, self._relevant if mind.zooms else every)
        self._failures = self._in_vain = 0

    @property
    def effects(self) -> tuple[str, ...]:
        """The coarse literals that the action is to bring about."""
        return self._effects

    def run(self) -> Steps:
        """Carries the action out, as far as that can be done."""
        yield from self._looking.look()
        while max(self._failures, self._in_vain) < _PATIENCE:
            plan = yield from self._planned()
            if not plan:
                return plan is not None and self._is_settled()
            self._in_vain += yield from self._follow(plan)
            if self._is_settled():
                return True
        self._mind.tally.failed(f"{self.action} failed {_PATIENCE} times in a row")
        return False

    def _follow(self, plan: Sequence[str]) -> Steps:
        """Does one action after another, as long as nothing upsets the plan."""
        for number, action in enumerate(plan, start=1):
            self._looking.clear()
            done = yield from self._do(action)
            self._failures = 0 if done else self._failures + 1
            if not done or self._is_upset(plan[number:]):
                return False
        return True

    def _do(self, action: str) -> Steps:
        """Attempts a concrete action and tests what came of it; then looks around, or why not."""
        mind = self._mind
        expected = mind.effects.of(action, mind.belief.known.true | mind.plain)
        mind.tally.action()
        mind.pending = expected
        percept = yield action
        self._looking.hear(percept)
        outcome: list[str] = []
        for effect in expected:
            came_out = yield from self._looking.outcome(effect, percept)
            outcome += [] if came_out is None else [came_out]
        mind.pending = ()
        mind.assume(outcome)
        self._looking.commit(literal for literal in outcome if mind.tests.of(literal) is not None)
        if outcome == list(expected):
            yield from self._looking.look()
            return True
        missing = (effect for effect in expected if effect not in outcome)
        mind.tally.failed(f"{action}: not {', '.join(missing)}")
        yield from self._looking.doubt(action)
        return False

    def _planned(self) -> Generator[str, Percept, tuple[str, ...] | None]:
        """A plan; where a decision reaches one of its limits the robot waits, and goes on after."""
        while True:
            try:
                with deciding(self._mind.limits):
                    return self._plan()
            except LimitError as limit:
                self._mind.tally.failed(str(limit))
                self._looking.hear((yield _WAIT))

    def _plan(self) -> tuple[str, ...] | None:
        """A shortest plan for the effects; None if nothing in the zoomed domain leads to them.

        What else is so, and is not to change, is part of the goal where the plan would change it;
        unless there is no other.
        """
        mind = self._mind
        with mind.tally.planning():
            candidates = self._candidates()
            plan = mind.plan(self._effects, candidates, self._relevant) if all(candidates) else None
            if plan and (lasting := self._spoilt(plan)):
                goal = (*self._effects, *lasting)
                plan = mind.plan(goal, candidates, self._relevant) or plan
        if plan:
            mind.tally.plan(plan)
        return plan

    def _spoilt(self, plan: Sequence[str]) -> tuple[str, ...]:
        """What is known to hold and is not to change, if a plan has effects contrary to it."""
        mind = self._mind
        true = mind.belief.known.true | mind.plain
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
        needed = self._mind.means.conditions.get(self.action, frozenset())
        inertial = self._before.intersection(self._mind.coarse.inertial)
        return tuple(
            group
            for fluent in sorted(inertial)
            if self._mind.is_magnified(fluent) and not about.isdisjoint(arguments(fluent))
            for group in self._mind.belief.candidates(fluent)
            if group or fluent in needed
        )

    def _about(self) -> frozenset[str]:
        """The constants of the action, and those related to them otherwise than by place."""
        about = set(arguments(self.action))
        inertial = self._before.intersection(self._mind.coarse.inertial)
        ties = [set(arguments(f)) for f in inertial if not self._mind.is_value(f)]
        while further := [tie for tie in ties if not about.isdisjoint(tie) and not tie <= about]:
            about.update(*further)
        return frozenset(about)

    def _is_settled(self) -> bool:
        """Whether the action is done; then what nobody can see of its effects is believed, too."""
        done = self._is_done()
        if done:
            self._mind.assume(self._effects)
        return done

    def _is_done(self) -> bool:
        """Whether the effects follow from what is known.

        Of fluents without counterparts an indirect effect follows unless the contrary is shown.
        """
        mind = self._mind
        with mind.tally.inferring():
            magnified = [atom(e) for e in self._effects if mind.is_magnified(e)]
            follows = mind.belief.coarse(magnified)
        return all(
            effect in follows
            if mind.is_magnified(effect)
            else mind.holds(effect)
            or (effect not in self._direct and complement(effect) not in mind.shown)
            for effect in self._effects
        )

    def _is_upset(self, rest: Sequence[str]) -> bool:
        """Whether something new is about what the rest of a plan acts upon.

        A thing that is found where it is acted upon next was expected there, and one that is not
        found elsewhere was not.
        """
        if not rest:
            return False
        about, next_to_hand = self._wholes(rest), self._wholes(rest[:1])
        if not self._looking.heard.isdisjoint(about):
            return True
        return any(
            whole in about and is_positive(literal) != (whole in next_to_hand)
            for literal in self._looking.seen
            for whole in self._wholes([literal]) & self._looking.looked_for
        )

    def _wholes(self, literals: Iterable[str]) -> set[str]:
        """The coarse constants that literals or actions are about, the robot apart."""
        wholes = self._mind.refinement.wholes
        named = {wholes.get(c, c) for literal in literals for c in arguments(literal)}
        return named - {self._mind.coarse.robot}
