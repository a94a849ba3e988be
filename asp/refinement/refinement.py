"""A coarse description together with its refinements."""

from __future__ import annotations

import re
from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property, lru_cache
from itertools import product

from asp.language import (
    MOST_TEXTS,
    Description,
    Problems,
    Signature,
    SourceError,
    analyse,
    arguments,
    atom,
    check,
    check_cycles,
    complement,
    ground,
    is_positive,
    may_have_cycles,
    name,
    parse,
    parse_description,
    signature_of,
    syntax,
)
from asp.refinement.completeness import check_complete
from asp.refinement.facts import Facts
from asp.refinement.language import parse_fine
from asp.refinement.maps import check_maps
from asp.refinement.observation import check_tested, observation_text, tested_fluents
from asp.refinement.refining import weak_text
from asp.refinement.statics import true_statics
from asp.refinement.vocabulary import Vocabulary, vocabulary_of


@dataclass(frozen=True, eq=False)
class Refinement:
    """D_c and D_f: `weak` is the physics of D_f, `strong` has the theory of observation, too.

    The refined descriptions are texts and their syntax: their instances are many more than a
    program needs, so that nothing here makes them.
    """

    coarse: syntax.Source
    coarse_signature: Signature
    vocabulary: Vocabulary
    weak: syntax.Source
    weak_signature: Signature
    strong: syntax.Source
    strong_signature: Signature

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

    @cached_property
    def weak_facts(self) -> Facts:
        """The weak refinement, its ground facts found by their constants."""
        return Facts(self.weak)

    @cached_property
    def strong_facts(self) -> Facts:
        """The strong refinement, its ground facts found by their constants."""
        return Facts(self.strong)

    @property
    def counterparts(self) -> Mapping[str, str]:
        """The names of the counterparts: `loc` to `fine_loc`, `move` to `fine_move`."""
        return self.vocabulary.counterparts

    @cached_property
    def _coarse_names(self) -> Mapping[str, str]:
        return {fine: coarse for coarse, fine in self.counterparts.items()}

    def coarse_of(self, literal: str) -> tuple[str, ...]:
        """What a fine literal or action says at the coarse resolution by itself.

        `fine_loc(object1_1,room1_2)` says `loc(object1,room1)`; a negative one says something
        only of constants with one component. What has no counterpart says itself.
        """
        coarse = self._coarse_names.get(name(literal))
        if coarse is None:
            return (literal,)
        lifted = ground(coarse, (self.wholes[part] for part in arguments(literal)))
        if is_positive(literal):
            return (lifted,)
        return (complement(lifted),) if len(self._components(lifted)) == 1 else ()

    def counterpart(self, literal: str) -> tuple[tuple[str, ...], ...]:
        """The groups of fine literals each of which makes the coarse literal true.

        A fluent is true if its counterpart is true of some components, and false if it is false
        of all. What has no counterpart is its own.
        """
        if name(literal) not in self.counterparts:
            return ((literal,),)
        fine = self._components(atom(literal))
        if is_positive(literal):
            return tuple((found,) for found in fine)
        return (tuple(map(complement, fine)),)

    def _components(self, coarse: str) -> tuple[str, ...]:
        parts = product(*(self.components[constant] for constant in arguments(coarse)))
        return tuple(ground(self.counterparts[name(coarse)], args) for args in parts)


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
    check_maps(fine, coarse, vocabulary, true_statics(weak, weak_signature), problems)
    tested = tested_fluents(fine, weak_signature, problems)
    check_complete(fine, coarse, vocabulary, problems)
    problems.raise_first()
    strong = _with(weak, observation_text(fine, vocabulary, tested))
    strong_signature = _signature(strong, fine)
    return Refinement(coarse, signature, vocabulary, weak, weak_signature, strong, strong_signature)


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
    if not may_have_cycles(weak, signature):
        return
    problems = Problems(weak.file)
    check_cycles(weak, signature, problems)
    for problem in problems:
        law = weak.text.split("\n")[problem.line - 1].strip()
        raise SourceError(fine.file, 1, 1, f"{problem.message}: {law}")
