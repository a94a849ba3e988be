"""One abstract action carried out: zoom, plan, act, test each outcome, search, plan again."""

from __future__ import annotations

from collections.abc import Generator, Iterable, Sequence

from agents.intentional.executor.belief import Mind
from agents.intentional.executor.coarse import CoarseDiagram
from agents.intentional.executor.sensing import Sensing
from agents.intentional.executor.zoomed_planning import ZoomedPlanner
from asp.language import arguments, atom, complement, is_positive
from asp.solving import LimitError, State, deciding
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
        self, mind: Mind, coarse: CoarseDiagram, action: str, before: State, step: int
    ) -> None:
        """`before` is the coarse state that the action is to lead from."""
        self._mind = mind
        self.action = action
        after = coarse.after(before, action, ())
        assert after is not None, "a robot attempts what it believes to be possible"
        self._planner = ZoomedPlanner(mind, action, before, after, coarse.inertial)
        with mind.tally.timing("planning"):
            self._direct = mind.means.direct_effects.get(action, frozenset())
            things = mind.looked_for(self._planner.relevant)
        self._sensing = Sensing(mind, before, after, things)
        every = mind.refinement.coarse_signature.constants
        zoomed = self._planner.relevant if mind.zooms else every
        mind.tally.note(abstract=action, begun=step, zoomed=sorted(zoomed))
        self._failures = self._in_vain = 0

    @property
    def effects(self) -> tuple[str, ...]:
        """The coarse literals that the action is to bring about."""
        return self._planner.effects

    def run(self) -> Steps:
        """Carries the action out, as far as that can be done."""
        yield from self._sensing.look()
        while max(self._failures, self._in_vain) < _PATIENCE:
            plan = yield from self._planned()
            if not plan:
                return plan is not None and self._is_settled()
            self._in_vain += yield from self._follow(plan)
            if self._is_settled():
                return True
        self._mind.tally.note(failed=f"{self.action} failed {_PATIENCE} times in a row")
        return False

    def _follow(self, plan: Sequence[str]) -> Steps:
        """Does one action after another, as long as nothing upsets the plan."""
        for number, action in enumerate(plan, start=1):
            self._sensing.clear()
            done = yield from self._do(action)
            self._failures = 0 if done else self._failures + 1
            if not done or self._is_upset(plan[number:]):
                return False
        return True

    def _do(self, action: str) -> Steps:
        """Attempts a concrete action and tests what came of it; then looks around, or why not."""
        mind = self._mind
        expected = mind.effects.of(action, mind.belief.known.true | mind.unmagnified)
        mind.tally.count("actions")
        mind.pending = expected
        percept = yield action
        self._sensing.hear(percept)
        outcome: list[str] = []
        for effect in expected:
            came_out = yield from self._sensing.outcome(effect, percept)
            outcome += [] if came_out is None else [came_out]
        mind.pending = ()
        mind.assume(outcome)
        self._sensing.commit(literal for literal in outcome if mind.tests.of(literal) is not None)
        if outcome == list(expected):
            yield from self._sensing.look()
            return True
        missing = (effect for effect in expected if effect not in outcome)
        mind.tally.note(failed=f"{action}: not {', '.join(missing)}")
        yield from self._sensing.doubt(action)
        return False

    def _planned(self) -> Generator[str, Percept, tuple[str, ...] | None]:
        """A plan; where a decision reaches one of its limits the robot waits, and goes on after."""
        while True:
            try:
                with deciding(self._mind.limits):
                    return self._planner.plan()
            except LimitError as limit:
                self._mind.tally.note(failed=str(limit))
                self._sensing.hear((yield _WAIT))

    def _is_settled(self) -> bool:
        """Whether the action is done; then what nobody can see of its effects is believed, too."""
        done = self._is_done()
        if done:
            self._mind.assume(self.effects)
        return done

    def _is_done(self) -> bool:
        """Whether the effects follow from what is known.

        Of fluents without counterparts an indirect effect follows unless the contrary is shown.
        """
        mind = self._mind
        with mind.tally.timing("infer"):
            magnified = [atom(e) for e in self.effects if mind.is_magnified(e)]
            follows = mind.belief.coarse(magnified)
        return all(
            effect in follows
            if mind.is_magnified(effect)
            else mind.holds(effect)
            or (effect not in self._direct and complement(effect) not in mind.shown)
            for effect in self.effects
        )

    def _is_upset(self, rest: Sequence[str]) -> bool:
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
            whole in about and is_positive(literal) != (whole in next_to_hand)
            for literal in self._sensing.seen
            for whole in self._wholes([literal]) & self._sensing.looked_for
        )

    def _wholes(self, literals: Iterable[str]) -> set[str]:
        """The coarse constants that literals or actions are about, the robot apart."""
        wholes = self._mind.refinement.wholes
        named = {wholes.get(c, c) for literal in literals for c in arguments(literal)}
        return named - {self._mind.robot}
