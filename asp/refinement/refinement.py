"""A refinement: made of texts or files, checked, and what it says of both resolutions."""

import re
from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property, lru_cache
from itertools import product
from pathlib import Path

from asp.language import (
    MOST_TEXTS,
    Description,
    Literal,
    Problems,
    Signature,
    SourceError,
    analyse,
    check,
    check_cycles,
    packaged_domains,
    parse,
    parse_description,
    read_domain,
    read_packaged,
    signature_of,
    static_truth,
    syntax,
)
from asp.refinement.language import Refines, Vocabulary, parse_fine, vocabulary_of
from asp.refinement.maps import map_mistakes
from asp.refinement.observation import observation_text, tested_fluents, untested
from asp.refinement.refining import weak_text


@dataclass(frozen=True, eq=False)
class CoarseDomain:
    """D_c: a coarse description by itself, as its laws and its signature."""

    coarse: syntax.Source
    coarse_signature: Signature


@dataclass(frozen=True, eq=False)
class Refinement(CoarseDomain):
    """D_c and D_f: `weak` is the physics of D_f, `strong` has the theory of observation, too.

    `statics` are those that are true, the same in both. `text` is what refines D_c, as it was read.

    The refined descriptions are texts and their syntax: their instances are many more than a
    program needs, so that nothing here makes them.
    """

    vocabulary: Vocabulary
    weak: syntax.Source
    weak_signature: Signature
    strong: syntax.Source
    strong_signature: Signature
    statics: frozenset[Literal]
    text: str

    @cached_property
    def description(self) -> Description:
        """The ground coarse description."""
        return parse_description(self.coarse.text, self.coarse.file)

    @property
    def components(self) -> Mapping[str, tuple[str, ...]]:
        """The components of each coarse constant; one that is not magnified is its own."""
        return self.vocabulary.components

    @cached_property
    def wholes(self) -> Mapping[str, str]:
        """The coarse constant to which each fine constant belongs."""
        return {part: whole for whole, parts in self.components.items() for part in parts}

    @cached_property
    def constants(self) -> frozenset[str]:
        """The constants of either resolution."""
        return self.coarse_signature.constants.union(self.wholes)

    @property
    def counterparts(self) -> Mapping[str, str]:
        """The names of the counterparts: `loc` to `fine_loc`, `move` to `fine_move`."""
        return self.vocabulary.counterparts

    @cached_property
    def _coarse_names(self) -> Mapping[str, str]:
        return {fine: coarse for coarse, fine in self.counterparts.items()}

    def coarse_of(self, literal: Literal) -> tuple[Literal, ...]:
        """What a fine literal or action says at the coarse resolution by itself.

        `fine_loc(object1_1,room1_2)` says `loc(object1,room1)`; a negative one says something
        only of constants with one component. What has no counterpart says itself.
        """
        fine = Literal.parse(literal)
        coarse = self._coarse_names.get(fine.name)
        if coarse is None:
            return (fine,)
        wholes = [self.wholes[part] for part in fine.arguments]
        if not fine.is_positive and any(len(self.components[whole]) > 1 for whole in wholes):
            return ()
        return (Literal.of(coarse, wholes, fine.is_positive),)

    def counterpart(self, literal: Literal) -> tuple[tuple[Literal, ...], ...]:
        """The groups of fine literals each of which makes the coarse literal true.

        A fluent is true if its counterpart is true of some components, and false if it is false
        of all. What has no counterpart is its own.
        """
        coarse = Literal.parse(literal)
        if coarse.name not in self.counterparts:
            return ((coarse,),)
        name = self.counterparts[coarse.name]
        parts = product(*(self.components[constant] for constant in coarse.arguments))
        fine = tuple(Literal.of(name, args, coarse.is_positive) for args in parts)
        return tuple((found,) for found in fine) if coarse.is_positive else (fine,)


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
    problems.report_all(map_mistakes(fine, coarse, vocabulary, statics))
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
        raise SourceError(fine.file, syntax.Place(*next(places, (1, 1))), problem.message)
    return signature


def _with(weak: syntax.Source, observation: str) -> syntax.Source:
    """The weak refinement with further sections behind it, which are parsed where they stand."""
    added = parse("\n" * (weak.text.count("\n") + 1) + observation, weak.file)
    text, statements = f"{weak.text}\n{observation}", weak.statements + added.statements
    return syntax.Source(weak.file, text, statements, weak.comments + added.comments)


def _check_cycles(weak: syntax.Source, signature: Signature, fine: syntax.Source) -> None:
    """Raises SourceError where the refined laws define something through its own negation.

    The place is that of the refinement's text, the message tells the law.
    """
    problems = Problems(weak.file)
    check_cycles(weak, signature, problems)
    for problem in problems:
        law = weak.text.split("\n")[problem.line - 1].strip()
        raise SourceError(fine.file, syntax.Place(1, 1), f"{problem.message}: {law}")


def load_refinement(name_or_path: str) -> Refinement:
    """The refinement of a file, or of a packaged one by its name (`level.fine`).

    It refines what its `refines` statement names: a packaged domain, or a file beside it. Raises
    SourceError, and FileNotFoundError where there is no such file.
    """
    file, text = read_refinement(name_or_path)
    named = next(parse_fine(text, file).each(Refines), None)
    if named is None:
        message = "it does not say which description it refines: begin with 'refines NAME.'"
        raise SourceError(file, syntax.Place(1, 1), message)
    beside = Path(file).parent / named.name
    try:
        coarse_file, coarse_text = read_domain(str(beside) if beside.is_file() else named.name)
    except FileNotFoundError as error:
        raise SourceError(file, named.place, str(error)) from None
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
