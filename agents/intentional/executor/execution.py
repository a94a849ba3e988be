"""One abstract action carried out: zoom, plan, act, test each outcome, search, plan again."""

from __future__ import annotations

from collections.abc import Generator, Iterable, Mapping, Sequence
from functools import cache

from agents.intentional.executor.mind import Mind
from asp.literals import arguments, atom, complement, is_positive
from asp.refinement import Refinement
from asp.refinement.zooming import Transition, fine_goal, relevant
from asp.solving import OUT_OF_TIME, TimeLimitError, time_limit
from testbed.link.messages import Percept

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
        self._before, self._after = before, after
        transition = Transition(before, action, after)
        with mind.tally.planning():
            self._relevant = relevant(mind.refinement.coarse, transition, mind.goal)
            self._effects = fine_goal(mind.refinement, transition, self._relevant).effects
            self._things = mind.looked_for(self._relevant)
        self._looked_for: set[str] = set()
        every = mind.refinement.coarse_signature.constants
        mind.tally.begin(action, step, self._relevant if mind.zooms else every)
        self._failures = self._in_vain = 0
        self._seen: list[str] = []
        self._heard: set[str] = set()
        self._disturbed: set[str] = set()

    @property
    def effects(self) -> tuple[str, ...]:
        """The coarse literals that the action is to bring about."""
        return self._effects

    def run(self) -> Steps:
        """Carries the action out, as far as that can be done."""
        yield from self._look()
        while max(self._failures, self._in_vain) < _PATIENCE:
            plan = yield from self._planned()
            if not plan:
                return plan is not None and self._is_done()
            self._in_vain += yield from self._follow(plan)
            if self._is_done():
                return True
        self._mind.tally.failed(f"{self.action} failed {_PATIENCE} times in a row")
        return False

    def _follow(self, plan: Sequence[str]) -> Steps:
        """Does one action after another, as long as nothing upsets the plan."""
        for number, action in enumerate(plan, start=1):
            self._seen, self._heard = [], set()
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
        percept = yield action
        self._hear(percept)
        outcome: list[str] = []
        for effect in expected:
            outcome += [(yield from self._outcome(effect, percept))]
        self._commit(literal for literal in outcome if mind.tests.of(literal) is not None)
        if outcome == list(expected):
            yield from self._look()
            return True
        missing = (effect for effect in expected if effect not in outcome)
        mind.tally.failed(f"{action}: not {', '.join(missing)}")
        yield from self._doubt(action)
        return False

    def _outcome(self, effect: str, percept: Percept) -> Generator[str, Percept, str]:
        """The effect if it came about, as far as that can be observed; else its complement.

        A test that shows nothing was not possible: the robot is not where it wanted to be.
        """
        if self._mind.tests.of(effect) is None:
            return complement(effect) if complement(effect) in percept.visible else effect
        holds = yield from self._read(effect)
        return effect if holds == is_positive(effect) else complement(effect)

    def _look(self) -> Generator[str, Percept, None]:
        """Tests what can be tested here of what is relevant, where it is not known."""
        mind, true = self._mind, self._mind.belief.known.true
        robots = {c for f in true if mind.coarse.robot in arguments(f) for c in arguments(f)}
        for fluent in list(mind.tests.possible(true, self._things)):
            if mind.belief.is_open(fluent):
                things = set(arguments(fluent)) - robots
                self._looked_for.update(mind.refinement.wholes[thing] for thing in things)
                yield from self._test(fluent)

    def _doubt(self, action: str) -> Generator[str, Percept, None]:
        """Tests again what an action that failed took for granted."""
        mind = self._mind
        about = {mind.refinement.wholes.get(part, part) for part in arguments(action)}
        things = mind.looked_for(about)
        for fluent in [*mind.tests.possible(mind.belief.known.true, things)]:
            if fluent in mind.belief.known.true:
                yield from self._test(fluent)

    def _test(self, fluent: str) -> Generator[str, Percept, None]:
        """Tests a fluent and takes the outcome for certain.

        An outcome contrary to the coarse belief is tested once more. Absence is certain then if it
        is found again; where the fluent was found true a third test decides.
        """
        holds = yield from self._read(fluent)
        if holds is not None and self._expected(fluent) == (not holds):
            holds = yield from self._read(fluent)
            if holds:
                holds = yield from self._read(fluent)
        if holds is not None:
            self._commit([fluent if holds else complement(fluent)])

    def _expected(self, fluent: str) -> bool | None:
        """Whether a fine fluent may be true by the coarse belief; None where that is changing."""
        for coarse in self._mind.refinement.coarse_of(fluent):
            if not self._disturbed.isdisjoint(arguments(coarse)):
                return None
            if (coarse in self._before) == (coarse in self._after):
                return coarse in self._before
        return None

    def _read(self, fluent: str) -> Generator[str, Percept, bool | None]:
        """The outcome of a test; None if it shows nothing."""
        test = self._mind.tests.of(atom(fluent))
        assert test is not None, "only what can be tested is tested"
        self._mind.tally.test()
        percept = yield test
        self._hear(percept)
        if atom(fluent) in percept.visible:
            return True
        return False if complement(atom(fluent)) in percept.visible else None

    def _planned(self) -> Generator[str, Percept, tuple[str, ...] | None]:
        """A plan; where the time for a decision runs out the robot waits, and goes on after."""
        while True:
            try:
                with time_limit(self._mind.decision_s):
                    return self._plan()
            except TimeLimitError:
                self._mind.tally.failed(OUT_OF_TIME)
                self._hear((yield _WAIT))

    def _plan(self) -> tuple[str, ...] | None:
        """A shortest plan for the effects; None if nothing in the zoomed domain leads to them."""
        mind = self._mind
        with mind.tally.planning():
            candidates = self._candidates()
            plan = mind.plan(self._effects, candidates, self._relevant) if all(candidates) else None
        if plan:
            mind.tally.plan(plan)
        return plan

    def _candidates(self) -> tuple[tuple[str, ...], ...]:
        """Where the things that the action is about may be, by the coarse belief.

        A fluent that is known to be false by now stands in the way of an action that depends on it,
        and of no other: to go to a room a robot need not find there what it expected.
        """
        about = frozenset(arguments(self.action))
        needed = _conditions(self._mind.refinement).get(self.action, frozenset())
        return tuple(
            group
            for fluent in sorted(self._before)
            if self._mind.is_magnified(fluent) and not about.isdisjoint(arguments(fluent))
            for group in self._mind.belief.candidates(fluent)
            if group or fluent in needed
        )

    def _is_done(self) -> bool:
        """Whether the effects follow from what is known."""
        mind = self._mind
        with mind.tally.inferring():
            magnified = [atom(e) for e in self._effects if mind.is_magnified(e)]
            follows = mind.belief.coarse(magnified)
        return all(
            effect in follows
            if mind.is_magnified(effect)
            else (atom(effect) in mind.plain) == is_positive(effect)
            for effect in self._effects
        )

    def _commit(self, literals: Iterable[str]) -> None:
        """Takes observations of the present moment for certain."""
        mind, seen = self._mind, list(literals)
        new = [literal for literal in seen if not self._is_known(literal)]
        with mind.tally.inferring():
            mind.belief.see(seen)
        mind.tally.committed(new)
        self._seen += new

    def _is_known(self, literal: str) -> bool:
        known = self._mind.belief.known
        return atom(literal) in (known.true if is_positive(literal) else known.false)

    def _hear(self, percept: Percept) -> None:
        with self._mind.tally.inferring():
            touched = self._mind.hear(percept)
        self._heard |= touched
        self._disturbed |= touched

    def _is_upset(self, rest: Sequence[str]) -> bool:
        """Whether something new is about what the rest of a plan acts upon.

        A thing that is found where it is acted upon next was expected there, and one that is not
        found elsewhere was not.
        """
        if not rest:
            return False
        about, next_to_hand = self._wholes(rest), self._wholes(rest[:1])
        if not self._heard.isdisjoint(about):
            return True
        return any(
            whole in about and is_positive(literal) != (whole in next_to_hand)
            for literal in self._seen
            for whole in self._wholes([literal]) & self._looked_for
        )

    def _wholes(self, literals: Iterable[str]) -> set[str]:
        """The coarse constants that literals or actions are about, the robot apart."""
        wholes = self._mind.refinement.wholes
        named = {wholes.get(c, c) for literal in literals for c in arguments(literal)}
        return named - {self._mind.coarse.robot}


@cache
def _conditions(refinement: Refinement) -> Mapping[str, frozenset[str]]:
    """The fluents on which it depends whether a coarse action is possible."""
    found: dict[str, frozenset[str]] = {}
    for law in refinement.description.executability:
        for action in law.actions:
            found[action] = found.get(action, frozenset()).union(map(atom, law.body))
    return found
