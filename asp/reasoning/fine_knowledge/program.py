"""The program of what a robot knows at the fine resolution: laws of D_f about partial knowledge.

Completed by `asp/theories/fine_inference.lp`. Each state constraint derives its head from what is
known of its body, at every step. One with a single fluent as condition also speaks the other way:
if its head is known to be false, so is its body. What is true of inertial fluents is carried on.
"""

from __future__ import annotations

from collections.abc import Collection, Iterator
from dataclasses import replace

from asp.language import Signature, syntax
from asp.language import variable_sorts as roles
from asp.translation import condition, rule, schema, sort_conditions, term_text

Laws = Collection[syntax.StateConstraint]


def inference_program(source: syntax.Source, signature: Signature) -> str:
    """The rules for a description (D_f, perhaps restricted) over holds(F,I), I a `step`.

    bridge(F,G) says that the defined fluent F is true where G is; it is there of fluents whose
    every law has one fluent, to be true, as its condition.
    """
    every = list(source.each(syntax.StateConstraint))
    laws = [law for law in every if _kind(law.head, signature) != "static"]
    statics = [law for law in every if _kind(law.head, signature) == "static"]
    lines = [*_sort_facts(signature), *_static_rules(source, statics, laws, signature)]
    lines += (line for law in laws for line in _derivations(law, signature))
    lines += _bridges([law for law in laws if _kind(law.head, signature) == "defined"], signature)
    lines += (_carried(d) for d in source.each(syntax.Declaration) if d.kind == "inertial")
    return "\n".join(lines)


def _derivations(law: syntax.StateConstraint, signature: Signature) -> Iterator[str]:
    yield _derivation(law, signature)
    fluents = _fluents(law, signature)
    if [_kind(literal, signature) for literal in (law.head, *fluents)] == ["inertial", "inertial"]:
        (only,) = fluents
        rest = (part for part in law.body if part is not only)
        yield _derivation(replace(law, head=_not(only), body=(_not(law.head), *rest)), signature)


def _derivation(law: syntax.StateConstraint, signature: Signature) -> str:
    head = f"{'' if law.head.positive else '-'}holds({term_text(law.head.atom)},I)"
    body = (condition(part, signature) for part in law.body)
    return rule(head, [*body, *sort_conditions(law, signature), "step(I)"])


def _bridges(laws: Laws, signature: Signature) -> Iterator[str]:
    """bridge(F,G) for the instances of laws `F if G`, of whose heads all laws are like that."""
    others = {law.head.atom.name for law in laws if not _is_bridge(law, signature)}
    for law in laws:
        if law.head.atom.name not in others:
            (fluent,) = _fluents(law, signature)
            body = [condition(part, signature) for part in law.body if part is not fluent]
            head = f"bridge({term_text(law.head.atom)},{term_text(fluent.atom)})"
            yield rule(head, [*body, *sort_conditions(law, signature)])


def _is_bridge(law: syntax.StateConstraint, signature: Signature) -> bool:
    return law.head.positive and [f.positive for f in _fluents(law, signature)] == [True]


def _carried(declaration: syntax.Declaration) -> str:
    fluent = schema(declaration).term
    return f"carried({fluent},I) :- holds({fluent},I)."


def _sort_facts(signature: Signature) -> Iterator[str]:
    for sort, members in signature.sorts.items():
        yield f"{sort}({'; '.join(members)})." if members else f"#defined {sort}/1."


def _static_rules(
    source: syntax.Source, constraints: Laws, laws: Laws, signature: Signature
) -> Iterator[str]:
    """The statics that laws speak of, closed where a law asks for one to be false."""
    asked = [
        part for law in laws for part in roles.literals(law.body) if _is_static(part, signature)
    ]
    named = {literal.atom.name for literal in asked}
    for symbol in sorted(named):
        yield f"#defined {symbol}/{len(signature.symbols[symbol].sorts)}."
    for fact in source.each(syntax.Fact):
        if fact.literal.atom.name in named:
            yield f"{term_text(fact.literal.atom)}."
    for law in constraints:
        if law.head.atom.name in named:
            body = (condition(part, signature) for part in law.body)
            yield rule(term_text(law.head.atom), [*body, *sort_conditions(law, signature)])
    for symbol in sorted({literal.atom.name for literal in asked if not literal.positive}):
        atom, _, sorts = schema(signature.symbols[symbol])
        yield rule(f"-{atom}", [*sorts, f"not {atom}"])


def _fluents(law: syntax.StateConstraint, signature: Signature) -> list[syntax.Literal]:
    return [part for part in roles.literals(law.body) if _kind(part, signature) in roles.FLUENTS]


def _is_static(literal: syntax.Literal, signature: Signature) -> bool:
    return _kind(literal, signature) == "static"


def _kind(literal: syntax.Literal, signature: Signature) -> str:
    symbol = signature.symbols.get(literal.atom.name)
    return roles.SORT if symbol is None else symbol.kind


def _not(literal: syntax.Literal) -> syntax.Literal:
    return replace(literal, positive=not literal.positive)
