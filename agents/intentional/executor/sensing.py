"""Tests in the middle of an abstract action: which are made, and when an outcome is believed."""

from collections.abc import Collection, Generator, Iterable
from typing import TypeVar

from agents.intentional.executor.belief import FineTracker
from asp.language import Action, Fluent, Literal
from asp.refinement import Transition
from testbed.protocol import Percept

T = TypeVar("T")

Asking = Generator[Action, Percept, T]
"""Yields concrete actions and tests, and is sent the percepts after them."""


class Sensing:
    """What is observed in the course of one abstract action.

    `seen` are the literals newly known by tests, `heard` the constants that news is about, both
    since they were last cleared; `looked_for` are the coarse constants that were tested for.
    """

    def __init__(self, fine: FineTracker, transition: Transition, things: Collection[str]) -> None:
        """`transition` is that of the abstract action; `things` are tested for."""
        self._fine = fine
        self._before, self._after = transition.before, transition.after
        self._things = things
        self._disturbed: set[str] = set()
        self.looked_for: set[str] = set()
        self.clear()

    def clear(self) -> None:
        """What is new from now on."""
        self.seen: list[Literal] = []
        self.heard: set[str] = set()

    def look(self) -> Asking[None]:
        """Tests what can be tested here of what is relevant, where it is not known.

        What a test finds may be what another one needs.
        """
        true = self._fine.belief.known.true
        robots = {c for f in true if self._fine.robot in f.arguments for c in f.arguments}
        tested: set[Fluent] = set()
        while possible := self._open(tested):
            for fluent in filter(self._fine.belief.is_open, possible):
                things = set(fluent.arguments) - robots
                wholes = self._fine.refinement.wholes
                self.looked_for.update(wholes.get(thing, thing) for thing in things)
                yield from self._test(fluent)
            tested.update(possible)

    def _open(self, tested: Collection[Fluent]) -> list[Fluent]:
        """What can be tested here and is not known, apart from what has been tested."""
        possible = self._fine.testable(self._things)
        return [f for f in possible if f not in tested and self._fine.belief.is_open(f)]

    def doubt(self, action: Action) -> Asking[None]:
        """Tests again what an action that failed took for granted, and what is not certain."""
        about = {self._fine.refinement.wholes.get(part, part) for part in action.arguments}
        things = self._fine.looked_for(about)
        with self._fine.trace.timing("infer"):
            doubtful = self._fine.belief.known.true - self._fine.certain().known.true
        for fluent in [*self._fine.testable(things)]:
            if fluent in doubtful and fluent in self._fine.belief.known.true:
                yield from self._test(fluent)

    def outcome(self, effect: Literal, percept: Percept) -> Asking[Literal | None]:
        """The effect if it came about, as far as that can be observed; else its complement.

        Where the attempt took no effect, what cannot be observed is as it was: nothing is tested
        that could show nothing, and nothing is returned. Otherwise a test that shows nothing was
        not possible: the robot is not where it wanted to be.
        """
        failed = percept.happened is False
        if self._fine.test_of(effect) is None:
            if effect.complement in percept.visible:
                return effect.complement
            return None if failed and effect not in percept.visible else effect
        if failed and not self._fine.can_test(effect):
            return None
        holds = yield from self._read(effect)
        return effect if holds == effect.is_positive else effect.complement

    def commit(self, literals: Iterable[Literal]) -> None:
        """Takes observations of the present moment for certain."""
        with self._fine.trace.timing("infer"):
            seen = self._fine.believable(literals)
            known = self._fine.belief.known
            new = [s for s in seen if s.atom not in (known.true if s.is_positive else known.false)]
            self._fine.belief.see(seen)
        self._fine.trace.add("committed", new)
        self.seen += new

    def hear(self, percept: Percept) -> None:
        with self._fine.trace.timing("infer"):
            touched = self._fine.hear(percept)
        self.heard |= touched
        self._disturbed |= touched

    def _test(self, fluent: Fluent) -> Asking[None]:
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
            self.commit([fluent if holds else fluent.complement])

    def _expected(self, fluent: Fluent) -> bool | None:
        """Whether a fine fluent may be true by the coarse belief; None where that is changing."""
        for coarse in self._fine.refinement.coarse_of(fluent):
            if not self._disturbed.isdisjoint(coarse.arguments):
                return None
            if (coarse in self._before) == (coarse in self._after):
                return coarse in self._before
        return None

    def _read(self, fluent: Fluent) -> Asking[bool | None]:
        """The outcome of a test; None if it shows nothing."""
        test = self._fine.test_of(fluent.atom)
        assert test is not None, "only what can be tested is tested"
        self._fine.trace.add("tests")
        percept = yield test
        self.hear(percept)
        if fluent.atom in percept.visible:
            return True
        return False if fluent.atom.complement in percept.visible else None
