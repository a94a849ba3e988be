"""What a robot knows at the fine resolution, and what follows from it at the coarse one."""

from __future__ import annotations

from collections.abc import Collection, Iterable, Iterator, Sequence
from dataclasses import dataclass
from typing import Protocol

from clingo import Symbol

from asp.language import arguments, atom, is_positive, narrowed, restrict
from asp.reasoning.fine_knowledge.program import inference_program
from asp.refinement import Refinement
from asp.solving import Recent, fact, first_model, ground, theory

_REMEMBERED = 64


@dataclass(frozen=True)
class Known:
    """Inertial fluents of D_f: those known to be true, and those observed to be false."""

    true: frozenset[str] = frozenset()
    false: frozenset[str] = frozenset()

    def without(self, literals: Iterable[str]) -> Known:
        """What is left when literals are forgotten."""
        gone = frozenset(literals)
        return Known(self.true - gone, frozenset(f for f in self.false if f"-{f}" not in gone))


@dataclass(frozen=True)
class Inferred:
    """What is known; the fluents that may be true or false; the coarse literals that follow."""

    known: Known
    possible: frozenset[str]
    coarse: frozenset[str]


class FineKnowledge(Protocol):
    """What follows from observations in a refinement."""

    def after(self, known: Known, seen: Collection[str]) -> Known:
        """What is known after literals seen at one step.

        What was known before gives way to what was seen, and to what follows from it; where that
        leaves a choice, as little as possible is forgotten. Raises ValueError if the literals
        contradict each other.
        """

    def is_false(self, known: Known, fluent: str) -> bool:
        """Whether an inertial fluent is known to be false."""

    def coarse(self, known: Known, fluents: Collection[str]) -> frozenset[str]:
        """What follows of coarse fluents that have counterparts, as literals."""


class ReferenceFineKnowledge:
    """`FineKnowledge` by the theory `fine_inference.lp`, solved anew at every call."""

    def __init__(self, refinement: Refinement) -> None:
        self._refinement = refinement
        self._programs: Recent[frozenset[str], str] = Recent(_REMEMBERED)

    def infer(
        self, known: Known, seen: Sequence[Collection[str]], about: Collection[str]
    ) -> Inferred:
        """What is known after literals were seen, step by step, where some things were known.

        Where they contradict each other, as few as possible of the earlier ones are forgotten.
        What else is inferred is about the coarse constants in `about`, and about those named.
        Raises ValueError if the literals of one step contradict each other.
        """
        literals = [*known.true, *known.false, *(literal for step in seen for literal in step)]
        wholes = self._refinement.wholes
        named = (wholes.get(name, name) for literal in literals for name in arguments(literal))
        whole = frozenset([*about, *named])
        program = self._programs.get(whole, lambda: self._make_program(whole))
        texts = [program, theory("fine_inference")]
        facts = [*_known(known), *_seen(seen)]
        for most in range(len(literals) + 1):
            control = ground(texts, {"now": len(seen), "most": most}, facts)
            model = first_model(control)
            if model is not None:
                return _read(model)
        raise ValueError("literals seen at one step contradict each other")

    def after(self, known: Known, seen: Collection[str]) -> Known:
        """What is known after literals seen at one step."""
        return self.infer(known, [seen], ()).known

    def is_false(self, known: Known, fluent: str) -> bool:
        """Whether an inertial fluent is known to be false."""
        about = {self._refinement.wholes[part] for part in arguments(fluent)}
        inferred = self.infer(known, [], about)
        return fluent not in inferred.known.true and fluent not in inferred.possible

    def coarse(self, known: Known, fluents: Collection[str]) -> frozenset[str]:
        """What follows of coarse fluents that have counterparts, as literals."""
        about = {constant for fluent in fluents for constant in arguments(fluent)}
        inferred = self.infer(known, [], about).coarse
        return frozenset(literal for literal in inferred if atom(literal) in fluents)

    def _make_program(self, about: frozenset[str]) -> str:
        refinement = self._refinement
        parts = {part for whole in about for part in refinement.components[whole]}
        every = refinement.weak_signature.constants
        gone = every.difference(about, parts)
        source = restrict(refinement.weak, gone)
        return inference_program(source, narrowed(refinement.weak_signature, gone))


def _known(known: Known) -> Iterator[Symbol]:
    for fluents, truth in ((known.true, "true"), (known.false, "false")):
        yield from (fact("known", fluent, truth) for fluent in sorted(fluents))


def _seen(seen: Iterable[Collection[str]]) -> Iterator[Symbol]:
    for step, literals in enumerate(seen, start=1):
        for literal in sorted(literals):
            truth = "true" if is_positive(literal) else "false"
            yield fact("seen", atom(literal), truth, step)


def _read(model: Iterable[Symbol]) -> Inferred:
    found: dict[str, set[str]] = {"true": set(), "false": set(), "possible": set()}
    coarse: set[str] = set()
    for symbol in model:
        fluent = str(symbol.arguments[0])
        if symbol.name == "coarse":
            coarse.add(fluent if str(symbol.arguments[1]) == "true" else f"-{fluent}")
        else:
            found[symbol.name].add(fluent)
    known = Known(frozenset(found["true"]), frozenset(found["false"]))
    return Inferred(known, frozenset(found["possible"]), frozenset(coarse))
