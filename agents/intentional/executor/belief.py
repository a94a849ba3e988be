"""The belief tracker of both resolutions in the course of a trial."""

from __future__ import annotations

from collections.abc import Collection, Iterable, Iterator
from copy import copy

from agents.intentional.executor.model import FineBelief, fine_model
from agents.intentional.executor.trace import FineTraceBuilder
from agents.shared import limits_of
from asp.language import Action, Fluent, Literal
from asp.refinement import Refinement
from asp.solving import State
from testbed.protocol import Percept, Task


class FineTracker:
    """The robot's knowledge and means at the fine resolution, for one trial.

    `unmagnified` are the true fluents without counterparts, as far as they are believed; `shown`
    are the literals about such fluents that the last percept had, and `noticed` the fluents of
    which there was any since the coarse robot was last asked; `pending` are the effects of an
    action that were not tested yet.
    """

    def __init__(self, refinement: Refinement, robot: str, task: Task, zooms: bool) -> None:
        """`zooms` if plans are made in the relevant part of the description only."""
        self.refinement = refinement
        self.robot = robot
        self.goal = tuple(task.goal)
        self.limits = limits_of(task)
        self.zooms = zooms
        self.trace = FineTraceBuilder()
        self.model = fine_model(refinement)
        self._sensing = self.model.sensing
        self.effects = self.model.effects
        self.belief = FineBelief(self.model, ())
        self.unmagnified: frozenset[Literal] = frozenset()
        self.shown: frozenset[Literal] = frozenset()
        self.noticed: set[Literal] = set()
        self.pending: tuple[Literal, ...] = ()
        self.news: list[tuple[int, Action]] = []

    def copy(self) -> FineTracker:
        """The same, of a trial that may go on otherwise."""
        other = copy(self)
        other.trace, other.belief = copy(self.trace), copy(self.belief)
        other.noticed, other.news = self.noticed.copy(), [*self.news]
        return other

    def become(self, other: FineTracker) -> None:
        """As another one is now, which stays apart from this one."""
        self.__dict__ = vars(other.copy())

    def know(self, literals: Iterable[Literal], coarse: Collection[Literal]) -> None:
        """Begins with what is known of both resolutions.

        Of the coarse one it tells what the robot does not have, or where it is not; where things
        are is another matter: that is looked for. What is defined changes with what it follows
        from, and is not remembered.
        """
        magnified = frozenset(filter(self.is_magnified, coarse))
        self.belief = FineBelief(self.model, literals)
        fluents = [
            part.atom
            for literal in magnified
            if self.robot in literal.arguments
            for parts in self.refinement.counterpart(literal)
            for part in parts
            if self.refinement.weak_signature.kind(part.name) == "inertial"
            and (not part.is_positive or self.belief.is_false(part))
        ]
        self.belief.see(fluent.complement for fluent in fluents)
        self._suppose(frozenset(each for each in coarse if each.is_positive) - magnified)

    def is_magnified(self, literal: Literal) -> bool:
        """Whether a coarse literal has a counterpart."""
        return literal.name in self.refinement.counterparts

    @property
    def true(self) -> frozenset[Literal]:
        """The fluents that are known, or believed, to be true."""
        return self.belief.known.true | self.unmagnified

    def testable(self, things: Collection[str]) -> Iterator[Fluent]:
        """The fluents about these things that can be tested now, by what is known and believed."""
        return self._sensing.possible(self.robot, self._sensing.facts(self.true), things)

    def test_of(self, fluent: Fluent) -> Action | None:
        """The robot's test of a fluent; None where there is none."""
        return self._sensing.test_of(self.robot, fluent)

    def can_test(self, fluent: Fluent) -> bool:
        """Whether there is a test of the fluent, possible by what is known and believed."""
        test = self.test_of(fluent)
        return test is not None and self._sensing.can(test, self._sensing.facts(self.true))

    def is_value(self, fluent: Fluent) -> bool:
        """Whether a coarse fluent is one of several of which one always holds, as of places."""
        return self.model.is_value(self.refinement.counterpart(fluent)[0][0])

    def hear(self, percept: Percept) -> frozenset[str]:
        """Takes in what is told beside the outcome of a test; the constants it is about.

        These are reports of events, and what is seen of fluents without a counterpart.
        """
        touched: set[str] = set()
        for event in percept.events:
            self.news.append((event.step, event.action))
            effects = self.effects.of(event.action, self.belief.known.true)
            self.assume(effects)
            self.belief.see(self.believable(filter(self._is_fine, effects)))
            touched.update(c for effect in effects for c in effect.arguments)
        self.shown = frozenset(filter(self._is_unmagnified, percept.visible))
        self.noticed.update(each.atom for each in self.shown)
        new = [literal for literal in self.shown if not self.holds(literal)]
        touched.update(c for literal in new for c in literal.arguments)
        self.assume(new)
        wholes = self.refinement.wholes
        return frozenset([*touched, *(wholes.get(constant, constant) for constant in touched)])

    def certain(self) -> FineBelief:
        """What the robot knows of itself, with what follows: tests of that are always right."""
        changing = frozenset(each.atom for each in self.pending)
        certain = FineBelief(self.model, filter(self._is_own, self.belief.known.true - changing))
        certain.suppose(frozenset(filter(self._is_own, self.unmagnified - changing)))
        return certain

    def believable(self, literals: Iterable[Literal]) -> list[Literal]:
        """Those of the literals seen at one moment that agree with what is certain.

        A thing that is held is where the robot is: seen elsewhere, or not seen there, it was
        mistaken.
        """
        seen = list(literals)
        if all(map(self._is_own, seen)):
            return seen
        certain = self.certain()
        certain.see(filter(self._is_own, seen))
        return [
            literal for literal in seen if self._is_own(literal) or not certain.contradicts(literal)
        ]

    def holding(self, literals: Collection[Literal]) -> list[Literal]:
        """Those of coarse literals that follow from what is known, or are believed."""
        follows = self.belief.coarse([each.atom for each in literals if self.is_magnified(each)])
        return [
            each
            for each in literals
            if (each in follows if self.is_magnified(each) else self.holds(each))
        ]

    def holds(self, literal: Literal) -> bool:
        """Whether a literal without a counterpart is believed."""
        return (literal.atom in self.unmagnified) == literal.is_positive

    def assume(self, literals: Iterable[Literal]) -> None:
        """Believes what literals say of fluents without counterparts."""
        unmagnified = list(filter(self._is_unmagnified, literals))
        gone = (literal.atom for literal in unmagnified)
        new = (literal for literal in unmagnified if literal.is_positive)
        self._suppose(self.unmagnified.difference(gone).union(new))

    def agree(self, expected: State, believed: State, fluents: Collection[Fluent]) -> None:
        """Believes of these fluents what the coarse robot does, which expected something else.

        What was known to the contrary at the fine resolution is old.
        """
        with self.trace.timing("infer"):
            self.belief.adapt(expected, believed, list(filter(self.is_magnified, fluents)))
        left = self.unmagnified.difference(fluents)
        self._suppose(left.union(f for f in believed if not self.is_magnified(f)))
        self.noticed.clear()

    def _suppose(self, unmagnified: frozenset[Literal]) -> None:
        self.unmagnified = unmagnified
        self.belief.suppose(unmagnified)

    def looked_for(self, wholes: Iterable[str]) -> frozenset[str]:
        """What is tested for of some coarse constants: one component, where they share a place."""
        components = (self.refinement.components[whole] for whole in wholes)
        shares = self.model.shares_places
        return frozenset(part for parts in components for part in (parts[:1] if shares else parts))

    def is_doubtful(self, literal: Literal) -> bool:
        """Whether a coarse literal rests on tests that may be wrong."""
        is_tested = self.is_magnified(literal) or self.test_of(literal.atom) is not None
        return is_tested and not self._is_own(literal)

    def _is_own(self, literal: Literal) -> bool:
        """Whether a literal is about the robot itself."""
        return self.robot in literal.arguments

    def _is_fine(self, literal: Literal) -> bool:
        return literal.name in self.refinement.counterparts.values()

    def _is_unmagnified(self, literal: Literal) -> bool:
        symbols = self.refinement.coarse_signature.symbols
        return literal.name in symbols and not self.is_magnified(literal)
