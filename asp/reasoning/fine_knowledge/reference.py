"""Knowledge at the fine resolution, and the inferences from it at the coarse one."""

from __future__ import annotations

from collections.abc import Collection, Iterable, Iterator, Sequence
from dataclasses import dataclass, replace
from typing import Protocol

from clingo import Symbol

from asp.language import Action, Fluent, Literal, Signature, narrowed, restrict, syntax
from asp.language import variable_sorts as roles
from asp.refinement import Refinement
from asp.solving import Recent, fact, first_model, ground, literal_of, theory
from asp.translation import condition, rule, schema, sort_conditions

_REMEMBERED = 64

Laws = Collection[syntax.StateConstraint]


@dataclass(frozen=True)
class Known:
    """Inertial fluents of D_f: those known to be true, and those observed to be false."""

    true: frozenset[Fluent] = frozenset()
    false: frozenset[Fluent] = frozenset()

    def without(self, literals: Iterable[Literal]) -> Known:
        """What is left when literals are forgotten."""
        gone = frozenset(literals)
        return Known(self.true - gone, frozenset(f for f in self.false if f"-{f}" not in gone))


@dataclass(frozen=True)
class Inferred:
    """What is known; the fluents that may be true or false; the coarse literals that follow."""

    known: Known
    possible: frozenset[Action]
    coarse: frozenset[Literal]


class FineKnowledge(Protocol):
    """What follows from observations in a refinement."""

    def after(self, known: Known, seen: Collection[Literal]) -> Known:
        """What is known after literals seen at one step.

        What was known before gives way to what was seen, and to what follows from it; where that
        leaves a choice, as little as possible is forgotten. Raises ValueError if the literals
        contradict each other.
        """

    def is_false(self, known: Known, fluent: Fluent) -> bool:
        """Whether an inertial fluent is known to be false."""

    def coarse(self, known: Known, fluents: Collection[Fluent]) -> frozenset[Literal]:
        """What follows of coarse fluents that have counterparts, as literals."""


class ReferenceFineKnowledge:
    """`FineKnowledge` by the theory `fine_inference.lp`, solved anew at every call."""

    def __init__(self, refinement: Refinement) -> None:
        self._refinement = refinement
        self._programs: Recent[frozenset[str], str] = Recent(_REMEMBERED)

    def infer(
        self, known: Known, seen: Sequence[Collection[Literal]], about: Collection[str]
    ) -> Inferred:
        """What is known after literals were seen, step by step, where some things were known.

        Where they contradict each other, as few as possible of the earlier ones are forgotten.
        What else is inferred is about the coarse constants in `about`, and about those named.
        Raises ValueError if the literals of one step contradict each other.
        """
        literals = [*known.true, *known.false, *(literal for step in seen for literal in step)]
        wholes = self._refinement.wholes
        named = (wholes.get(name, name) for literal in literals for name in literal.arguments)
        whole = frozenset([*about, *named])
        program = self._programs.get(whole, lambda: inference_program(self._refinement, whole))
        texts = [program, theory("fine_inference")]
        facts = list(_facts(known, seen))
        for most in range(len(literals) + 1):
            control = ground(texts, {"now": len(seen), "most": most}, facts)
            model = first_model(control)
            if model is not None:
                return _read(model)
        raise ValueError("literals seen at one step contradict each other")

    def after(self, known: Known, seen: Collection[Literal]) -> Known:
        """What is known after literals seen at one step."""
        return self.infer(known, [seen], ()).known

    def is_false(self, known: Known, fluent: Fluent) -> bool:
        """Whether an inertial fluent is known to be false."""
        about = {self._refinement.wholes[part] for part in fluent.arguments}
        inferred = self.infer(known, [], about)
        return fluent not in inferred.known.true and fluent not in inferred.possible

    def coarse(self, known: Known, fluents: Collection[Fluent]) -> frozenset[Literal]:
        """What follows of coarse fluents that have counterparts, as literals."""
        about = {constant for fluent in fluents for constant in fluent.arguments}
        inferred = self.infer(known, [], about).coarse
        return frozenset(literal for literal in inferred if literal.atom in fluents)


def _facts(known: Known, seen: Iterable[Collection[str]]) -> Iterator[Symbol]:
    for fluents, truth in ((known.true, "true"), (known.false, "false")):
        yield from (fact("known", fluent, truth) for fluent in sorted(fluents))
    for step, literals in enumerate(seen, start=1):
        for literal in map(Literal.parse, sorted(literals)):
            yield fact("seen", literal.atom, "true" if literal.is_positive else "false", step)


def _read(model: Iterable[Symbol]) -> Inferred:
    found: dict[str, set[Fluent]] = {"true": set(), "false": set(), "possible": set()}
    coarse: set[Literal] = set()
    for symbol in model:
        fluent = literal_of(symbol.arguments[0])
        if symbol.name == "coarse":
            coarse.add(fluent if str(symbol.arguments[1]) == "true" else fluent.complement)
        else:
            found[symbol.name].add(fluent)
    known = Known(frozenset(found["true"]), frozenset(found["false"]))
    return Inferred(known, frozenset(found["possible"]), frozenset(coarse))


def inference_program(refinement: Refinement, about: frozenset[str]) -> str:
    """The rules for what D_f says of some coarse constants, over holds(F,I), I a `step`.

    Completed by `asp/theories/fine_inference.lp`. Each state constraint derives its head from what
    is known of its body. One with a single fluent as condition also speaks the other way: if its
    head is known to be false, so is its body. What is true of inertial fluents is carried on.

    bridge(F,G) says that the defined fluent F is true where G is; it is there of fluents whose
    every law has one fluent, to be true, as its condition.
    """
    parts = {part for whole in about for part in refinement.components[whole]}
    gone = refinement.weak_signature.constants.difference(about, parts)
    source, signature = restrict(refinement.weak, gone), narrowed(refinement.weak_signature, gone)
    statics = [s for s in refinement.statics if gone.isdisjoint(s.arguments)]
    every = source.each(syntax.StateConstraint)
    laws = [law for law in every if _kind(law.head, signature) != "static"]
    defining = [law for law in laws if _kind(law.head, signature) == "defined"]
    inertial = [d for d in source.each(syntax.Declaration) if d.kind == "inertial"]
    sorts = signature.sorts.items()
    return "\n".join(
        [
            *(f"{s}({'; '.join(m)})." if m else f"#defined {s}/1." for s, m in sorts),
            *_static_rules(statics, laws, signature),
            *(line for law in laws for line in _derivations(law, signature)),
            *_bridges(defining, signature),
            *(f"carried({f},I) :- holds({f},I)." for f, *_ in map(schema, inertial)),
        ]
    )


def _derivations(law: syntax.StateConstraint, signature: Signature) -> Iterator[str]:
    yield _derivation(law, signature)
    fluents = _fluents(law, signature)
    if [_kind(literal, signature) for literal in (law.head, *fluents)] == ["inertial", "inertial"]:
        (only,) = fluents
        rest = (part for part in law.body if part is not only)
        yield _derivation(replace(law, head=_not(only), body=(_not(law.head), *rest)), signature)


def _derivation(law: syntax.StateConstraint, signature: Signature) -> str:
    head, *body = (condition(part, signature) for part in (law.head, *law.body))
    return rule(head, [*body, *sort_conditions(law, signature), "step(I)"])


def _bridges(laws: Laws, signature: Signature) -> Iterator[str]:
    """bridge(F,G) for the instances of laws `F if G`, of whose heads all laws are like that."""
    found = [(law, _fluents(law, signature)) for law in laws]
    others = {law.head.atom.name for law, own in found if [f.positive for f in own] != [True]}
    for law, fluents in found:
        if law.head.atom.name not in others:
            body = [condition(part, signature) for part in law.body if part not in fluents]
            body += sort_conditions(law, signature)
            yield rule(f"bridge({law.head.atom},{fluents[0].atom})", body)


def _static_rules(statics: Iterable[Literal], laws: Laws, signature: Signature) -> Iterator[str]:
    """The statics that laws speak of, closed where a law asks for one to be false."""
    parts = (part for law in laws for part in roles.literals(law.body))
    asked = [part for part in parts if _kind(part, signature) == "static"]
    named = {literal.atom.name for literal in asked}
    for symbol in sorted(named):
        yield f"#defined {symbol}/{len(signature.symbols[symbol].sorts)}."
    yield from (f"{static}." for static in sorted(statics) if static.name in named)
    for symbol in sorted({literal.atom.name for literal in asked if not literal.positive}):
        atom, _, sorts = schema(signature.symbols[symbol])
        yield rule(f"-{atom}", [*sorts, f"not {atom}"])


def _fluents(law: syntax.StateConstraint, signature: Signature) -> list[syntax.Literal]:
    return [part for part in roles.literals(law.body) if _kind(part, signature) in roles.FLUENTS]


def _kind(literal: syntax.Literal, signature: Signature) -> str:
    symbol = signature.symbols.get(literal.atom.name)
    return roles.SORT if symbol is None else symbol.kind


def _not(literal: syntax.Literal) -> syntax.Literal:
    return replace(literal, positive=not literal.positive)
