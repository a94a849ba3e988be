"""What a refinement's text has to say so that a robot can act by it."""

from __future__ import annotations

from collections.abc import Iterator

from asp.language import Problems, functions, syntax
from asp.refinement.language import Components, Counterpart, TestsStatement
from asp.refinement.vocabulary import Vocabulary


def check_complete(
    fine: syntax.Source, coarse: syntax.Source, vocabulary: Vocabulary, problems: Problems
) -> None:
    """Reports a fluent that nobody can test, and wholes whose parts could part.

    Of a fluent with a counterpart a robot knows what tests tell. A thing that is in one place at
    most is not, if nothing is said of its components.
    """
    _check_tests(fine, vocabulary, problems)
    _check_parts(fine, coarse, vocabulary, problems)


def _check_tests(fine: syntax.Source, vocabulary: Vocabulary, problems: Problems) -> None:
    tested = {statement.fluent.name for statement in fine.each(TestsStatement)}
    for statement in fine.each(Counterpart):
        name = statement.symbol.name
        counterpart = vocabulary.counterparts[name]
        if vocabulary.coarse.symbols[name].kind == "inertial" and counterpart not in tested:
            problems.report(
                statement.place,
                f"'{name}' has a counterpart that nobody can test; say in tests when a robot "
                f"tests '{counterpart}'",
            )


def _check_parts(
    fine: syntax.Source, coarse: syntax.Source, vocabulary: Vocabulary, problems: Problems
) -> None:
    said = {law.head.atom.name for law in fine.each(syntax.StateConstraint) if law.head.positive}
    reported: set[str] = set()
    for name, whole in _of_one_value(coarse, vocabulary):
        counterpart = vocabulary.counterparts[name]
        if len(vocabulary.components[whole]) > 1 and counterpart not in said | reported:
            reported.add(counterpart)
            place = next(s.place for s in fine.each(Components) if s.whole.name == whole)
            problems.report(
                place,
                f"'{whole}' has one value of '{name}' at most, and its components could have "
                f"several; add a law by which they share '{counterpart}'",
            )


def _of_one_value(coarse: syntax.Source, vocabulary: Vocabulary) -> Iterator[tuple[str, str]]:
    """The magnified constants that have at most one value of a fluent with a counterpart."""
    for name, function in functions(coarse, vocabulary.coarse).items():
        if name in vocabulary.counterparts:
            for place, sort in enumerate(vocabulary.coarse.symbols[name].sorts):
                if place != function.place:
                    members = vocabulary.coarse.sorts[sort.name]
                    yield from ((name, one) for one in members if vocabulary.is_magnified(one))
