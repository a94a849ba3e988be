"""What the executor has for a whole trial: both resolutions, what is known, what is counted."""

from __future__ import annotations

from collections.abc import Collection, Iterable, Iterator

from agents.intentional.executor.belief import FineBelief
from agents.intentional.executor.coarse_model import CoarseDiagram
from agents.intentional.executor.compiled import means_of
from agents.intentional.executor.trace import Tally
from agents.shared.limits import limits_of
from asp.language import arguments, atom, is_positive, name
from asp.reasoning.fine_planning import FineStart, NoPlan
from asp.refinement import Refinement, fine_constants
from testbed.protocol import Percept, Task


class Mind:
    """The robot's knowledge and means at the fine resolution, for one trial.

    `plain` are the true fluents of those that have no counterpart, as far as they are believed;
    `shown` are the literals about such fluents that the last percept had, and `noticed` the
    fluents of which there was any since the coarse robot was last asked; `pending` are the effects
    of an action that were not tested yet.
    """

    def __init__(
        self, refinement: Refinement, coarse: CoarseDiagram, task: Task, zooms: bool
    ) -> None:
        """`zooms` if plans are made in the relevant part of the description only."""
        self.refinement = refinement
        self.coarse = coarse
        self.goal = tuple(task.goal)
        self.limits = limits_of(task)
        self.zooms = zooms
        self.tally = Tally()
        self.means = means_of(refinement)
        self.tests = self.means.tests(coarse.robot)
        self.effects = self.means.effects
        self.belief = FineBelief(refinement, ())
        self.plain: frozenset[str] = frozenset()
        self.shown: frozenset[str] = frozenset()
        self.noticed: set[str] = set()
        self.pending: tuple[str, ...] = ()
        self.news: list[tuple[int, str]] = []

    def know(self, literals: Iterable[str], coarse: Collection[str]) -> None:
        """Begins with what is known of both resolutions.

        Of the coarse one it tells what the robot does not have, or where it is not; where things
        are is another matter: that is looked for.
        """
        magnified = frozenset(filter(self.is_magnified, coarse))
        self.belief = FineBelief(self.refinement, literals)
        fluents = [
            atom(part)
            for literal in magnified
            if self.coarse.robot in arguments(literal)
            for parts in self.refinement.counterpart(literal)
            for part in parts
            if not is_positive(part) or self.belief.is_false(part)
        ]
        self.belief.see(f"-{fluent}" for fluent in fluents)
        self._suppose(frozenset(filter(is_positive, coarse)) - magnified)

    def is_magnified(self, literal: str) -> bool:
        """Whether a coarse literal has a counterpart."""
        return name(literal) in self.refinement.counterparts

    def testable(self, things: Collection[str]) -> Iterator[str]:
        """The fluents about these things that can be tested now, by what is known and believed."""
        return self.tests.possible(self.belief.known.true | self.plain, things)

    def can_test(self, fluent: str) -> bool:
        """Whether a fluent of which there is a test can be tested now, by what is known."""
        return self.tests.is_possible(fluent, self.belief.known.true | self.plain)

    def is_value(self, fluent: str) -> bool:
        """Whether a coarse fluent is one of several of which one always holds, as of places."""
        return self.means.is_value(self.refinement.counterpart(fluent)[0][0])

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
            touched.update(c for effect in effects for c in arguments(effect))
        self.shown = frozenset(filter(self._is_plain, percept.visible))
        self.noticed.update(map(atom, self.shown))
        new = [literal for literal in self.shown if not self.holds(literal)]
        touched.update(c for literal in new for c in arguments(literal))
        self.assume(new)
        wholes = self.refinement.wholes
        return frozenset([*touched, *(wholes.get(constant, constant) for constant in touched)])

    def certain(self) -> FineBelief:
        """What the robot knows of itself, with what follows: tests of that are always right."""
        changing = frozenset(map(atom, self.pending))
        certain = FineBelief(
            self.refinement, filter(self._is_own, self.belief.known.true - changing)
        )
        certain.suppose(frozenset(filter(self._is_own, self.plain - changing)))
        return certain

    def believable(self, literals: Iterable[str]) -> list[str]:
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
            literal
            for literal in seen
            if self._is_own(literal)
            or not (
                certain.is_false(literal)
                if is_positive(literal)
                else atom(literal) in certain.known.true
            )
        ]

    def holds(self, literal: str) -> bool:
        """Whether a literal without a counterpart is believed."""
        return (atom(literal) in self.plain) == is_positive(literal)

    def assume(self, literals: Iterable[str]) -> None:
        """Believes what literals say of fluents without counterparts."""
        plain = list(filter(self._is_plain, literals))
        gone = (atom(literal) for literal in plain)
        self._suppose(self.plain.difference(gone).union(filter(is_positive, plain)))

    def agree(self, believed: Collection[str]) -> None:
        """Believes of fluents without counterparts what the coarse robot does."""
        left = self.plain.difference(self.coarse.fluents)
        self._suppose(left.union(f for f in believed if not self.is_magnified(f)))
        self.noticed.clear()

    def _suppose(self, plain: frozenset[str]) -> None:
        self.plain = plain
        self.belief.suppose(plain)

    def plan(
        self, goal: tuple[str, ...], candidates: tuple[tuple[str, ...], ...], zoom: Collection[str]
    ) -> tuple[str, ...] | None:
        """A shortest plan of concrete actions; None if there is none. Raises LimitError.

        By Definition 1 the place of the robot need not be relevant to what it does there; a state
        has to say where it is all the same.
        """
        zoom = frozenset(zoom) | self._whereabouts()
        constants = zoom | fine_constants(self.refinement, zoom)
        # What need not have a value is assumed to hold of the first component of which it may.
        assumed = {group[0] for group in candidates if not self.means.is_value(group[0])}
        values = tuple(group for group in candidates if group[0] not in assumed)
        start = FineStart(self.belief.known.true | assumed | self._inertial(), values)
        limit = sum(len(self.refinement.components[constant]) for constant in zoom) + 1
        found = self.means.planner.plan(start, goal, limit, constants if self.zooms else None)
        return None if isinstance(found, NoPlan) else found

    def _inertial(self) -> frozenset[str]:
        """What a state is told by, of fluents without counterparts: others follow by laws."""
        symbols = self.refinement.coarse_signature.symbols
        return frozenset(f for f in self.plain if symbols[name(f)].kind == "inertial")

    def _whereabouts(self) -> frozenset[str]:
        """The coarse constants of what is known of the robot itself."""
        robot, wholes = self.coarse.robot, self.refinement.wholes
        true = self.belief.known.true | self._inertial()
        own = (arguments(fluent) for fluent in true if robot in arguments(fluent))
        return frozenset(wholes.get(constant, constant) for named in own for constant in named)

    def looked_for(self, wholes: Iterable[str]) -> frozenset[str]:
        """What is tested for of some coarse constants: one component, where they share a place."""
        components = (self.refinement.components[whole] for whole in wholes)
        shares = self.means.shares_places
        return frozenset(part for parts in components for part in (parts[:1] if shares else parts))

    def is_doubtful(self, literal: str) -> bool:
        """Whether a coarse literal rests on tests that may be wrong."""
        return self.is_magnified(literal) and not self._is_own(literal)

    def _is_own(self, literal: str) -> bool:
        """Whether a literal is about the robot itself."""
        return self.coarse.robot in arguments(literal)

    def _is_fine(self, literal: str) -> bool:
        return name(literal) in self.refinement.counterparts.values()

    def _is_plain(self, literal: str) -> bool:
        symbols = self.refinement.coarse_signature.symbols
        return name(literal) in symbols and not self.is_magnified(literal)
