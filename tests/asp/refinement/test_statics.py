"""Statics of a description are those that clingo finds."""

import pytest

from asp.language import (
    Literal,
    Signature,
    analyse,
    packaged_domains,
    parse_description,
    read_domain,
    syntax,
    text_of,
)
from asp.language import variable_sorts as roles
from asp.solving import first_model, ground
from tests.asp.reasoning.stories import CART
from tests.asp.refinement.levels import level

MANY = """\
sorts
  a = {x, y, z}.
  b = {x} + {w}.
  none_of_it = {v}.
statics
  edge(a, a).
  path(a, a).
  apart(a, a).
  odd(b).
  flag.
facts
  edge(x, y).
  edge(X, X).
  flag.
  odd(w).
laws
  path(X, Y) if edge(X, Y), X != Y.
  path(X, Z) if path(X, Y), path(Y, Z).
  apart(X, Y) if -path(X, Y), flag.
  path(y, z) if odd(W), W = w.
  odd(X) if path(X, X2), b(X2).
"""


@pytest.mark.parametrize("domain", [*packaged_domains(), CART, "many", "L1", "L2"])
def test_they_are_the_same(domain: str) -> None:
    if domain in ("L1", "L2"):
        text, file = level(domain).weak.text, domain
    else:
        file, text = ("many", MANY) if domain == "many" else read_domain(domain)
    assert parse_description(text, file).statics == by_clingo(*analyse(text, file))


def test_some_are_derived_and_some_are_not() -> None:
    found = parse_description(MANY).statics
    assert {"path(x,z)", "apart(z,x)", "edge(y,y)", "flag", "odd(w)"} <= found
    assert "apart(x,z)" not in found


def by_clingo(source: syntax.Source, signature: Signature) -> frozenset[Literal]:
    """The true statics by clingo; none may depend on its own negation."""
    rules = [f"{sort}({';'.join(m)})." for sort, m in signature.sorts.items() if m]
    rules += (
        _rule(fact.literal.atom, _ranges([fact.literal.atom], signature))
        for fact in source.each(syntax.Fact)
    )
    for law in source.each(syntax.StateConstraint):
        if signature.symbols[law.head.atom.name].kind == "static":
            atoms = [use.atom for use in roles.uses(law)]
            body = [_condition(part) for part in law.body]
            rules.append(_rule(law.head.atom, [*body, *_ranges(atoms, signature)]))
    shown = [
        f"#show {name}/{len(declaration.sorts)}."
        for name, declaration in signature.symbols.items()
        if declaration.kind == "static"
    ]
    model = first_model(ground(["\n".join([*rules, "#show.", *shown])], {}, []))
    return frozenset(Literal.parse(str(static)) for static in model or ())


def _rule(head: syntax.Atom, body: list[str]) -> str:
    return f"{text_of(head)} :- {', '.join(body)}."


def _ranges(atoms: list[syntax.Atom], signature: Signature) -> list[str]:
    """The sorts of the variables, by all the places where they stand."""
    found = (
        f"{sort.name}({term.name})"
        for atom in atoms
        if atom.name in signature.symbols
        for term, sort in zip(atom.args, signature.symbols[atom.name].sorts, strict=True)
        if term.is_variable
    )
    return list(dict.fromkeys(found))


def _condition(part: syntax.Condition) -> str:
    if isinstance(part, syntax.Comparison):
        return text_of(part)
    return ("" if part.positive else "not ") + text_of(part.atom)
