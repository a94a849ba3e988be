"""Reading a refinement: texts or files in, the checked refined descriptions out."""

import re
from functools import lru_cache
from pathlib import Path

from asp.language import (
    MOST_TEXTS,
    Problems,
    Signature,
    SourceError,
    analyse,
    check,
    check_cycles,
    packaged_domains,
    parse,
    read_domain,
    read_packaged,
    signature_of,
    static_truth,
    syntax,
)
from asp.refinement.language import Refines, parse_fine, vocabulary_of
from asp.refinement.maps import check_maps
from asp.refinement.observation import observation_text, tested_fluents, untested
from asp.refinement.refinement import Refinement
from asp.refinement.refining import weak_text


@lru_cache(maxsize=MOST_TEXTS)
def load(coarse_text: str, coarse_file: str, text: str, file: str) -> Refinement:
    """The refinement of a coarse AL_d text by the text of a refinement. Raises SourceError."""
    coarse, signature = analyse(coarse_text, coarse_file)
    fine = parse_fine(text, file)
    problems = Problems(file)
    vocabulary = vocabulary_of(fine, signature, problems)
    problems.raise_first()
    in_coarse = Problems(coarse_file)
    refined = weak_text(coarse, fine, vocabulary, in_coarse)
    in_coarse.raise_first()
    weak = parse(refined, f"{file} (refined)")
    weak_signature = _signature(weak, fine)
    check(fine, weak_signature, problems)
    problems.raise_first()
    _check_cycles(weak, weak_signature, fine)
    statics, _ = static_truth(weak, weak_signature)
    check_maps(fine, coarse, vocabulary, statics, problems)
    tested = tested_fluents(fine, weak_signature, problems)
    problems.report_all(untested(fine, vocabulary))
    problems.raise_first()
    strong = _with(weak, observation_text(fine, vocabulary, tested))
    strong_signature = _signature(strong, fine)
    return Refinement(
        coarse, signature, vocabulary, weak, weak_signature, strong, strong_signature, statics, text
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


def _check_cycles(weak: syntax.Source, signature: Signature, fine: syntax.Source) -> None:
    """Raises SourceError where the refined laws define something through its own negation.

    The place is that of the refinement's text, the message tells the law.
    """
    problems = Problems(weak.file)
    check_cycles(weak, signature, problems)
    for problem in problems:
        law = weak.text.split("\n")[problem.line - 1].strip()
        raise SourceError(fine.file, 1, 1, f"{problem.message}: {law}")


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
    wanted = "refinement; give the path of a .fine file"
    known = (f"{name}.fine" for name in packaged_domains(".fine"))
    return read_packaged(name_or_path, name_or_path, wanted, known)


def refined_name(name_or_path: str) -> str | None:
    """What the `refines` statement of a file names, if it has one.

    Raises SourceError, and FileNotFoundError where there is no such file.
    """
    file, text = read_refinement(name_or_path)
    return next((statement.name for statement in parse_fine(text, file).each(Refines)), None)


def _coarse(file: str, text: str) -> tuple[str, str]:
    named = next(parse_fine(text, file).each(Refines), None)
    if named is None:
        message = "it does not say which description it refines: begin with 'refines NAME.'"
        raise SourceError(file, 1, 1, message)
    beside = Path(file).parent / named.name
    try:
        return read_domain(str(beside) if beside.is_file() else named.name)
    except FileNotFoundError as error:
        raise SourceError(file, named.place.line, named.place.column, str(error)) from None
