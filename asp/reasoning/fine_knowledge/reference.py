"""What a robot knows at the fine resolution, and what follows from it at the coarse one."""

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
        program = self._programs.get(whole, lambda: self._make_program(whole))
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

    def _make_program(self, about: frozenset[str]) -> str:
        refinement = self._refinement
        parts = {part for whole in about for part in refinement.components[whole]}
        every = refinement.weak_signature.constants
        gone = every.difference(about, parts)
        source = restrict(refinement.weak, gone)
        statics = [s for s in refinement.statics if gone.isdisjoint(s.arguments)]
        return inference_program(source, narrowed(refinement.weak_signature, gone), statics)


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


def inference_program(
    source: syntax.Source, signature: Signature, statics: Iterable[Literal]
) -> str:
    """The rules for a description (D_f, perhaps restricted) over holds(F,I), I a `step`.

    Completed by `asp/theories/fine_inference.lp`. Each state constraint derives its head from what
    is known of its body. One with a single fluent as condition also speaks the other way: if its
    head is known to be false, so is its body. What is true of inertial fluents is carried on.

    bridge(F,G) says that the defined fluent F is true where G is; it is there of fluents whose
    every law has one fluent, to be true, as its condition.
    """
    every = source.each(syntax.StateConstraint)
    laws = [law for law in every if _kind(law.head, signature) != "static"]
    defining = [law for law in laws if _kind(law.head, signature) == "defined"]
    inertial = [d for d in source.each(syntax.Declaration) if d.kind == "inertial"]
    return "\n".join(
        [
            *(
                f"{s}({'; '.join(m)})." if m else f"#defined {s}/1."
                for s, m in signature.sorts.items()
            ),
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
    others = {law.head.atom.name for law in laws if not _is_bridge(law, signature)}
    for law in laws:
        if law.head.atom.name not in others:
            (fluent,) = _fluents(law, signature)
            body = [condition(part, signature) for part in law.body if part is not fluent]
            head = f"bridge({law.head.atom},{fluent.atom})"
            yield rule(head, [*body, *sort_conditions(law, signature)])


def _is_bridge(law: syntax.StateConstraint, signature: Signature) -> bool:
    return law.head.positive and [f.positive for f in _fluents(law, signature)] == [True]


def _static_rules(statics: Iterable[Literal], laws: Laws, signature: Signature) -> Iterator[str]:
    """The statics that laws speak of, closed where a law asks for one to be false."""
    asked = [
        part
        for law in laws
        for part in roles.literals(law.body)
        if _kind(part, signature) == "static"
    ]
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
