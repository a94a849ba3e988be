"""Statements that are written are read as the same statements."""

import re
from dataclasses import fields, is_dataclass
from typing import Any

import pytest

from asp.language import packaged_domains, parse, read_domain, syntax, text_of
from tests.asp.reasoning.stories import CART
from tests.asp.refinement.levels import level

SECTIONS = {
    syntax.SortDefinition: "sorts",
    syntax.CausalLaw: "laws",
    syntax.StateConstraint: "laws",
    syntax.ExecutabilityCondition: "laws",
    syntax.Fact: "facts",
    syntax.SeesStatement: "sees",
    syntax.ShowsStatement: "shows",
    syntax.InitiallyStatement: "initially",
    syntax.TriggerStatement: "scenarios",
    syntax.QuietStatement: "scenarios",
}
OTHER = """\
sorts
  a = {1..3} + {x}.
fluents
  inertial flag.
actions
  agent ring.
  exogenous knock(a).
laws
  impossible ring, knock(A) if flag, A = x, A != 1.
  ring causes -flag.
  flag.
scenarios
  quiet-night: nothing.
  1: knock(A) upon ring drawing A with A != x, -ring if -flag probability 0.5.
  1: knock(A) upon any drawing A.
"""


def section_of(statement: syntax.Statement) -> str | None:
    if isinstance(statement, syntax.Declaration):
        kinds = {"static": "statics", "inertial": "fluents", "defined": "fluents"}
        return kinds.get(statement.kind, "actions")
    return SECTIONS.get(type(statement))


def said(item: Any) -> Any:
    """A statement without its places."""
    if isinstance(item, tuple):
        return tuple(map(said, item))
    if is_dataclass(item) and not isinstance(item, syntax.Place):
        values = (
            getattr(item, f.name) for f in fields(item) if f.name not in ("place", "last_line")
        )
        return (type(item), *map(said, values))
    return item


@pytest.mark.parametrize("domain", [*packaged_domains(), CART, "other", "L2"])
def test_what_is_written_is_read_again(domain: str) -> None:
    text = {"other": OTHER, "L2": level("L2").strong.text}.get(domain) or read_domain(domain)[1]
    written = [s for s in parse(text).statements if section_of(s)]
    assert len(written) > 5
    for statement in written:
        line = text_of(statement)
        assert re.fullmatch(r"[^\n%]*\.", line)
        (read,) = parse(f"{section_of(statement)}\n{line}\n").statements
        assert said(read) == said(statement)


def test_other_statements_are_not_written() -> None:
    (cost,) = parse("costs\n  ring costs 5.\n").statements
    with pytest.raises(TypeError, match="CostStatement"):
        text_of(cost)
