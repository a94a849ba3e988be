"""Reading a refinement: texts or files in, the checked refined descriptions out."""

from __future__ import annotations

import re
from collections.abc import Iterator
from functools import lru_cache
from importlib.resources import files
from pathlib import Path

from asp.language import (
    MOST_TEXTS,
    Problems,
    Signature,
    SourceError,
    analyse,
    check,
    check_cycles,
    functions,
    parse,
    read_domain,
    read_text,
    signature_of,
    static_truth,
    syntax,
)
from asp.refinement.language import Components, Counterpart, Refines, TestsStatement, parse_fine
from asp.refinement.maps import check_maps
from asp.refinement.observation import check_tested, observation_text, tested_fluents
from asp.refinement.refinement import Refinement
from asp.refinement.refining import weak_text
from asp.refinement.vocabulary import Vocabulary, vocabulary_of


@lru_cache(maxsize=MOST_TEXTS)
def load(coarse_text: str, coarse_file: str, fine_text: str, fine_file: str) -> Refinement:
    """The refinement of a coarse AL_d text by the text of a refinement. Raises SourceError."""
    coarse, signature = analyse(coarse_text, coarse_file)
    fine = parse_fine(fine_text, fine_file)
    problems = Problems(fine_file)
    vocabulary = vocabulary_of(fine, signature, problems)
    check_tested(fine, vocabulary, problems)
    problems.raise_first()
    in_coarse = Problems(coarse_file)
    text = weak_text(coarse, fine, vocabulary, in_coarse)
    in_coarse.raise_first()
    weak = parse(text, f"{fine_file} (refined)")
    weak_signature = _signature(weak, fine)
    _check_own(fine, weak_signature)
    _check_cycles(weak, weak_signature, fine)
    statics, _ = static_truth(weak, weak_signature)
    check_maps(fine, coarse, vocabulary, statics, problems)
    tested = tested_fluents(fine, weak_signature, problems)
    check_complete(fine, coarse, vocabulary, problems)
    problems.raise_first()
    strong = _with(weak, observation_text(fine, vocabulary, tested))
    strong_signature = _signature(strong, fine)
    return Refinement(
        coarse, signature, vocabulary, weak, weak_signature, strong, strong_signature, statics
    )


def _signature(refined: syntax.Source, fine: syntax.Source) -> Signature:
    """The signature of a refined description. Raises SourceError for a name that it cannot have.

    The place is that of the first statement in the refinement's text that has the name.
    """
    problems = Problems(refined.file)
    signature = signature_of(refined, problems)
    for problem in problems:
        name = next(iter(re.findall(r"'(\w+)'", problem.message)), "")
        lines = enumerate(fine.text.split("\n"), start=1)
        places = ((n, m.start() + 1) for n, t in lines for m in re.finditer(rf"\b{name}\b", t))
        line, column = next(places, (1, 1))
        raise SourceError(fine.file, line, column, problem.message)
    return signature


def _with(weak: syntax.Source, observation: str) -> syntax.Source:
    """The weak refinement with further sections behind it, which are parsed where they stand."""
    lines = weak.text.count("\n") + 1
    added = parse("\n" * lines + observation, weak.file)
    return syntax.Source(
        weak.file,
        f"{weak.text}\n{observation}",
        weak.statements + added.statements,
        weak.comments + added.comments,
    )


def _check_own(fine: syntax.Source, weak: Signature) -> None:
    """Checks the facts, laws and tests of a refinement's text, at their places in it."""
    problems = Problems(fine.file)
    check(fine, weak, problems)
    problems.raise_first()


def _check_cycles(weak: syntax.Source, signature: Signature, fine: syntax.Source) -> None:
    """Raises SourceError where the refined laws define something through its own negation.

    The place is that of the refinement's text, the message tells the law.
    """
    problems = Problems(weak.file)
    check_cycles(weak, signature, problems)
    for problem in problems:
        law = weak.text.split("\n")[problem.line - 1].strip()
        raise SourceError(fine.file, 1, 1, f"{problem.message}: {law}")


SUFFIX = ".fine"


def load_refinement(name_or_path: str) -> Refinement:
    """The refinement of a file, or of a packaged one by its name (`level.fine`).

    It refines what its `refines` statement names: a packaged domain, or a file beside it. Raises
    SourceError, and FileNotFoundError where there is no such file.
    """
    file, text = read_refinement(name_or_path)
    coarse_file, coarse_text = _coarse(file, text)
    return load(coarse_text, coarse_file, text, file)


def read_refinement(name_or_path: str) -> tuple[str, str]:
    """The file name, for errors, and the text of a refinement. Raises FileNotFoundError."""
    packaged = files("asp").joinpath("domains", name_or_path)
    if "/" not in name_or_path and packaged.is_file():
        return name_or_path, packaged.read_text(encoding="utf-8")
    path = Path(name_or_path)
    if not path.is_file():  # nor can it be where the name has a character that none of a file has
        raise FileNotFoundError(
            f"{name_or_path}: no such refinement; give the path of a {SUFFIX} file or one of "
            f"{', '.join(packaged_refinements())}"
        )
    return str(path), read_text(path)


def packaged_refinements() -> tuple[str, ...]:
    """The names of the refinements that come with this package."""
    entries = files("asp").joinpath("domains").iterdir()
    return tuple(sorted(e.name for e in entries if e.name.endswith(SUFFIX)))


def refined_name(name_or_path: str) -> str | None:
    """What the `refines` statement of a file names, if it has one.

    Raises SourceError, and FileNotFoundError where there is no such file.
    """
    file, text = read_refinement(name_or_path)
    return next((statement.name for statement in parse_fine(text, file).each(Refines)), None)


def _coarse(file: str, text: str) -> tuple[str, str]:
    statements = list(parse_fine(text, file).each(Refines))
    if not statements:
        message = "it does not say which description it refines: begin with 'refines NAME.'"
        raise SourceError(file, 1, 1, message)
    named = statements[0]
    beside = Path(file).parent / named.name
    try:
        return read_domain(str(beside) if beside.is_file() else named.name)
    except FileNotFoundError as error:
        raise SourceError(file, named.place.line, named.place.column, str(error)) from None


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
