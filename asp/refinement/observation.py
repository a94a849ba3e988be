"""The theory of observation that makes the weak refinement the strong one (P 3.3, 16)."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass

from asp.language import Problems, Signature, condition_text, syntax, variable_domains
from asp.refinement.language import TestsStatement
from asp.refinement.refining import shared_places
from asp.refinement.vocabulary import COMPONENT, Vocabulary

OUTCOME, TRUE, FALSE = "outcome", "true", "false"


@dataclass(frozen=True)
class Tested:
    """A fluent that a robot can test, with the statements that say when.

    The robot is the first argument of all that is said of the test. `own` are the places at which
    the fluent is about the robot itself; they are not repeated.
    """

    fluent: str
    sorts: tuple[str, ...]
    robot: str
    own: frozenset[int]
    statements: tuple[TestsStatement, ...]

    def terms(self, robot: str, others: Iterable[str]) -> tuple[str, ...]:
        """The fluent's arguments, of the robot and of what else stands in a test's places."""
        left = iter(others)
        return tuple(robot if p in self.own else next(left) for p in range(len(self.sorts)))

    def others(self, items: Sequence[str]) -> tuple[str, ...]:
        """Those of a fluent's arguments that stand behind the robot in a test."""
        return tuple(item for place, item in enumerate(items) if place not in self.own)


def check_tested(fine: syntax.Source, vocabulary: Vocabulary, problems: Problems) -> None:
    """Reports tests of coarse fluents, which are observed by way of their components only."""
    for statement in fine.each(TestsStatement):
        fluent = statement.fluent
        if fluent.name in vocabulary.counterparts:
            counterpart = vocabulary.counterparts[fluent.name]
            problems.report(
                fluent.place,
                f"'{fluent.name}' is observed by way of its components only; test '{counterpart}'",
            )


def tested_fluents(fine: syntax.Source, weak: Signature, problems: Problems) -> tuple[Tested, ...]:
    """What the tests of a refinement's text say, fluent by fluent. Reports what does not fit."""
    groups: dict[str, list[TestsStatement]] = {}
    for statement in fine.each(TestsStatement):
        groups.setdefault(statement.fluent.name, []).append(statement)
    return tuple(_tested(name, found, weak, problems) for name, found in groups.items())


def _tested(
    name: str, statements: list[TestsStatement], weak: Signature, problems: Problems
) -> Tested:
    sorts = tuple(sort.name for sort in weak.symbols[name].sorts)
    first, *others = statements
    robot = _robot_sort(first, weak)
    own = frozenset.intersection(*map(_own, statements))
    for statement in others:
        if _robot_sort(statement, weak) != robot:
            problems.report(
                statement.place,
                f"'{name}' is tested by another sort of robot than in line {first.place.line}, "
                f"which is '{robot}'",
            )
    return Tested(name, sorts, robot, own, tuple(statements))


def _own(statement: TestsStatement) -> frozenset[int]:
    robot = statement.robot
    return frozenset(
        place
        for place, term in enumerate(statement.fluent.args)
        if robot.is_variable and term.name == robot.name
    )


def _robot_sort(statement: TestsStatement, weak: Signature) -> str:
    """The smallest sort that has all the robots that the statement is about."""
    robots = variable_domains(statement, weak).get(statement.robot.name, (statement.robot.name,))
    fitting = [s for s, members in weak.sorts.items() if set(robots) <= set(members)]
    return min(fitting, key=lambda sort: len(weak.sorts[sort]))


def observation_text(fine: syntax.Source, vocabulary: Vocabulary, tested: Sequence[Tested]) -> str:
    """The theory of observation as sections of AL_d, to be put behind the weak refinement."""
    theory = _Theory(vocabulary, shared_places(fine), tested)
    laws = "\n\n".join(filter(None, theory.laws()))
    return "\n\n".join(
        [
            "% The theory of observation.",
            f"sorts\n  {OUTCOME} = {{{TRUE}, {FALSE}}}.",
            "fluents\n" + "\n".join(f"  {line}" for line in theory.fluents()),
            "actions\n" + "\n".join(f"  {line}" for line in theory.actions()),
            f"laws\n{laws}\n",
        ]
    )


class _Theory:
    """The declarations and laws about tests, and about what follows for the coarse fluents."""

    def __init__(
        self,
        vocabulary: Vocabulary,
        shared: frozenset[tuple[str, int]],
        tested: Sequence[Tested],
    ) -> None:
        self._vocabulary = vocabulary
        self._shared = shared
        self._tested = tested
        self._whole: Mapping[str, str] = {f: c for c, f in vocabulary.counterparts.items()}

    def fluents(self) -> Iterator[str]:
        for t in self._tested:
            places = (t.robot, *t.others(t.sorts))
            yield f"inertial {_signed('observed_' + t.fluent, (*places, OUTCOME))}."
            yield f"defined {_signed('can_test_' + t.fluent, places)}."
            if t.fluent in self._whole:
                coarse = self._whole[t.fluent]
                sorts = [s.name for s in self._vocabulary.coarse.symbols[coarse].sorts]
                places = (t.robot, *t.others(sorts))
                yield f"defined {_signed('observed_' + coarse, (*places, OUTCOME))}."
                yield f"defined {_signed('possible_' + coarse, places)}."

    def actions(self) -> Iterator[str]:
        for t in self._tested:
            yield f"agent {_signed('test_' + t.fluent, (t.robot, *t.others(t.sorts)))}."

    def laws(self) -> Iterator[str]:
        yield _group("A test changes what is known, and nothing else (16a).", self._effects())
        yield _group("What can be tested, and when (16b, 16c).", self._abilities())
        yield _group("An observation of one component is one of all that share it.", self._common())
        yield _group("What components tell of coarse fluents (16d).", self._indirect())

    def _effects(self) -> Iterator[str]:
        for t in self._tested:
            robot, others, fluent = self._atoms(t)
            test = _signed("test_" + t.fluent, (robot, *others))
            for outcome, sign in ((TRUE, ""), (FALSE, "-")):
                observed = _signed("observed_" + t.fluent, (robot, *others, outcome))
                yield f"{test} causes {observed} if {sign}{fluent}."
            one, other = (
                _signed("observed_" + t.fluent, (robot, *others, v)) for v in ("V1", "V2")
            )
            yield f"-{one} if {other}, V1 != V2."

    def _abilities(self) -> Iterator[str]:
        for t in self._tested:
            robot, others, _ = self._atoms(t)
            places = (robot, *others)
            can = _signed("can_test_" + t.fluent, places)
            yield f"impossible {_signed('test_' + t.fluent, places)} if -{can}."
            for statement in t.statements:
                yield _ability(t, statement)

    def _common(self) -> Iterator[str]:
        for t in self._tested:
            robot, others, _ = self._atoms(t)
            terms = t.terms(robot, others)
            for place in (p for f, p in self._shared if f == t.fluent and p not in t.own):
                seen = []
                for part in ("Y_1", "Y_2"):
                    items = [part if p == place else term for p, term in enumerate(terms)]
                    args = (robot, *t.others(items), "V")
                    seen.append(_signed("observed_" + t.fluent, args))
                links = f"{COMPONENT}(Y_1, X), {COMPONENT}(Y_2, X)"
                yield f"{seen[0]} if {seen[1]}, {links}."

    def _indirect(self) -> Iterator[str]:
        for t in self._tested:
            if t.fluent in self._whole:
                yield from self._indirect_of(t, self._whole[t.fluent])

    def _indirect_of(self, t: Tested, coarse: str) -> Iterator[str]:
        robot, others, _ = self._atoms(t)
        sorts = [sort.name for sort in self._vocabulary.coarse.symbols[coarse].sorts]
        wholes, links = [], []
        for sort, part in zip(t.others(sorts), others, strict=True):
            refined = self._vocabulary.touches(sort)
            wholes.append(part.replace("Y", "X") if refined else part)
            links += [f"{COMPONENT}({part}, {wholes[-1]})"] if refined else []
        tied = ", ".join(links)
        seen = [_signed("observed_" + t.fluent, (robot, *others, v)) for v in (TRUE, FALSE)]
        told = [_signed("observed_" + coarse, (robot, *wholes, v)) for v in (TRUE, FALSE)]
        possible = _signed("possible_" + coarse, (robot, *wholes))
        yield f"{told[0]} if {tied}, {seen[0]}."
        yield f"{possible} if {tied}, -{seen[1]}.  % some component is not known to be false"
        yield f"{told[1]} if -{possible}."

    @staticmethod
    def _atoms(t: Tested) -> tuple[str, tuple[str, ...], str]:
        """The robot's variable, those of the other places, and the fluent over them."""
        others = t.others([f"Y{place}" for place in range(1, len(t.sorts) + 1)])
        return "R", others, _signed(t.fluent, t.terms("R", others))


def _ability(t: Tested, statement: TestsStatement) -> str:
    terms = [term.name for term in statement.fluent.args]
    can = _signed("can_test_" + t.fluent, (statement.robot.name, *t.others(terms)))
    body = ", ".join(map(condition_text, statement.body))
    return f"{can} if {body}." if body else f"{can}."


def _signed(name: str, arguments: Iterable[str]) -> str:
    return f"{name}({', '.join(arguments)})"


def _group(heading: str, laws: Iterable[str]) -> str:
    lines = [f"  {law}" for law in laws]
    return "\n".join([f"  % {heading}", *lines]) if lines else ""
