"""The theory of observation that makes the weak refinement the strong one (P 3.3, 16)."""

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from functools import cached_property
from itertools import chain

from asp.language import Problems, Signature, syntax, text_of, variable_domains
from asp.refinement.language import COMPONENT, Counterpart, Mistakes, TestsStatement, Vocabulary
from asp.refinement.refining import law_section, section, shared_places

OUTCOME, TRUE, FALSE = "outcome", "true", "false"
TEST, CAN_TEST = "test_", "can_test_"


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

    @cached_property
    def terms(self) -> list[str]:
        """The variables of the fluent's arguments in laws."""
        return ["R" if p in self.own else f"Y{p + 1}" for p in range(len(self.sorts))]

    def others(self, items: Sequence[str]) -> list[str]:
        """Those of a fluent's arguments that stand behind the robot in a test."""
        return [item for place, item in enumerate(items) if place not in self.own]

    def said(self, prefix: str, *last: str) -> str:
        """What is said of the test, or is observed, in laws."""
        return _atom(prefix + self.fluent, "R", *self.others(self.terms), *last)


def untested(fine: syntax.Source, vocabulary: Vocabulary) -> Mistakes:
    """The fluents with counterparts that nobody can test: a robot knows of them what tests tell."""
    tested = {statement.fluent.name for statement in fine.each(TestsStatement)}
    for statement in fine.each(Counterpart):
        name = statement.symbol.name
        counterpart = vocabulary.counterparts[name]
        if vocabulary.coarse.symbols[name].kind == "inertial" and counterpart not in tested:
            say = f"say in tests when a robot tests '{counterpart}'"
            yield statement.place, f"'{name}' has a counterpart that nobody can test; {say}"


def tested_fluents(fine: syntax.Source, weak: Signature, problems: Problems) -> list[Tested]:
    """What the tests of a refinement's text say, fluent by fluent. Reports what does not fit."""
    groups: dict[str, list[TestsStatement]] = {}
    for statement in fine.each(TestsStatement):
        groups.setdefault(statement.fluent.name, []).append(statement)
    found = []
    for name, statements in groups.items():
        sorts = tuple(sort.name for sort in weak.symbols[name].sorts)
        robot, line = _robot_sort(statements[0], weak), statements[0].place.line
        own = frozenset(range(len(sorts)))
        for statement in statements:
            tester, terms = statement.robot, enumerate(statement.fluent.args)
            own &= {
                place for place, term in terms if tester.is_variable and term.name == tester.name
            }
            if _robot_sort(statement, weak) != robot:
                other = f"by another sort of robot than in line {line}, which is '{robot}'"
                problems.report(statement.place, f"'{name}' is tested {other}")
        found.append(Tested(name, sorts, robot, own, tuple(statements)))
    return found


def _robot_sort(statement: TestsStatement, weak: Signature) -> str:
    """The smallest sort that has all the robots that the statement is about."""
    robots = variable_domains(statement, weak).get(statement.robot.name, (statement.robot.name,))
    fitting = [s for s, members in weak.sorts.items() if set(robots) <= set(members)]
    return min(fitting, key=lambda sort: len(weak.sorts[sort]))


def observation_text(fine: syntax.Source, vocabulary: Vocabulary, tested: Sequence[Tested]) -> str:
    """The theory of observation as sections of AL_d, to be put behind the weak refinement."""
    shared = shared_places(fine)
    wholes = {counterpart: coarse for coarse, counterpart in vocabulary.counterparts.items()}
    coarse = {
        t.fluent: vocabulary.coarse.symbols[wholes[t.fluent]] for t in tested if t.fluent in wholes
    }
    indirect = (_indirect(t, coarse[t.fluent], vocabulary) for t in tested if t.fluent in coarse)
    groups = {
        "A test changes what is known, and nothing else (16a).": map(_effects, tested),
        "What can be tested, and when (16b, 16c).": map(_abilities, tested),
        "An observation of one component is one of all that share it.": (
            _common(t, shared) for t in tested
        ),
        "What components tell of coarse fluents (16d).": indirect,
    }
    tests = (_atom(TEST + t.fluent, t.robot, *t.others(t.sorts)) for t in tested)
    sections = (
        "% The theory of observation.",
        section("sorts", [f"{OUTCOME} = {{{TRUE}, {FALSE}}}."]),
        section("fluents", (d for t in tested for d in _fluents(t, coarse.get(t.fluent)))),
        section("actions", (f"agent {test}." for test in tests)),
        law_section({title: chain.from_iterable(laws) for title, laws in groups.items()}),
    )
    return "\n\n".join(sections) + "\n"


def _fluents(t: Tested, coarse: syntax.Declaration | None) -> Iterator[str]:
    own = t.robot, *t.others(t.sorts)
    yield f"inertial {_atom(f'observed_{t.fluent}', *own, OUTCOME)}."
    yield f"defined {_atom(CAN_TEST + t.fluent, *own)}."
    if coarse is not None:
        places = t.robot, *t.others([sort.name for sort in coarse.sorts])
        yield f"defined {_atom(f'observed_{coarse.name}', *places, OUTCOME)}."
        yield f"defined {_atom(f'possible_{coarse.name}', *places)}."


def _effects(t: Tested) -> Iterator[str]:
    for outcome, sign in ((TRUE, ""), (FALSE, "-")):
        observed = t.said("observed_", outcome)
        yield f"{t.said(TEST)} causes {observed} if {sign}{_atom(t.fluent, *t.terms)}."
    yield f"-{t.said('observed_', 'V1')} if {t.said('observed_', 'V2')}, V1 != V2."


def _abilities(t: Tested) -> Iterator[str]:
    yield f"impossible {t.said(TEST)} if -{t.said(CAN_TEST)}."
    for statement in t.statements:
        others = t.others([term.name for term in statement.fluent.args])
        can = _atom(CAN_TEST + t.fluent, statement.robot.name, *others)
        body = text_of(statement.body)
        yield f"{can} if {body}." if body else f"{can}."


def _common(t: Tested, shared: Iterable[tuple[str, int]]) -> Iterator[str]:
    for place in (p for fluent, p in shared if fluent == t.fluent and p not in t.own):
        one, other = (
            _atom(
                f"observed_{t.fluent}",
                *("R", *t.others([*t.terms[:place], part, *t.terms[place + 1 :]]), "V"),
            )
            for part in ("Y_1", "Y_2")
        )
        yield f"{one} if {other}, {COMPONENT}(Y_1, X), {COMPONENT}(Y_2, X)."


def _indirect(t: Tested, coarse: syntax.Declaration, vocabulary: Vocabulary) -> Iterator[str]:
    wholes, links = ["R"], []
    sorts = t.others([sort.name for sort in coarse.sorts])
    for sort, part in zip(sorts, t.others(t.terms), strict=True):
        refined = vocabulary.touches(sort)
        wholes.append(part.replace("Y", "X") if refined else part)
        links += [f"{COMPONENT}({part}, {wholes[-1]})"] if refined else []
    tied = ", ".join(links)
    true, false = (_atom(f"observed_{coarse.name}", *wholes, v) for v in (TRUE, FALSE))
    possible = _atom(f"possible_{coarse.name}", *wholes)
    yield f"{true} if {tied}, {t.said('observed_', TRUE)}."
    yield (
        f"{possible} if {tied}, -{t.said('observed_', FALSE)}."
        "  % some component is not known to be false"
    )
    yield f"{false} if -{possible}."


def _atom(name: str, *arguments: str) -> str:
    return f"{name}({', '.join(arguments)})"
