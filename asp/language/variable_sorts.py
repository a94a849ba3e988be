"""Which symbols may stand where in a statement, and what a variable there ranges over."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from functools import singledispatch

from asp.language import syntax

FLUENTS = frozenset({"inertial", "defined"})
DOMAIN = FLUENTS | {"static"}
AGENT = frozenset({"agent"})
EXOGENOUS = frozenset({"exogenous"})
ACTIONS = AGENT | EXOGENOUS
SORT = "sort"


@dataclass(frozen=True)
class Use:
    """An atom of a statement with the kinds of symbols that may stand there."""

    atom: syntax.Atom
    kinds: frozenset[str]
    wanted: str


@singledispatch
def uses(_statement: syntax.Statement) -> Iterator[Use]:
    """Every atom of the statement with its role; none in sorts and declarations."""
    yield from ()


@uses.register
def _(law: syntax.CausalLaw) -> Iterator[Use]:
    yield Use(law.action, ACTIONS, "an action before 'causes'")
    yield Use(law.head.atom, frozenset({"inertial"}), "an inertial fluent as the effect")
    yield from body_uses(law.body)


@uses.register
def _(law: syntax.StateConstraint) -> Iterator[Use]:
    yield Use(law.head.atom, DOMAIN, "a fluent or a static as the head")
    yield from body_uses(law.body)


@uses.register
def _(law: syntax.ExecutabilityCondition) -> Iterator[Use]:
    for action in law.actions:
        yield Use(action, ACTIONS, "an action after 'impossible'")
    yield from body_uses(law.body)


@uses.register
def _(fact: syntax.Fact) -> Iterator[Use]:
    yield Use(fact.literal.atom, frozenset({"static"}), "a static as a fact")


@uses.register
def _(statement: syntax.SeesStatement) -> Iterator[Use]:
    yield Use(statement.fluent, FLUENTS, "a fluent after 'sees'")
    yield from body_uses(statement.body)


@uses.register
def _(statement: syntax.ShowsStatement) -> Iterator[Use]:
    yield Use(statement.action, AGENT, "an agent action before 'shows'")
    yield Use(statement.fluent, FLUENTS, "a fluent after 'shows'")
    yield from body_uses(statement.body)


@uses.register
def _(statement: syntax.CostStatement) -> Iterator[Use]:
    yield Use(statement.action, AGENT, "an agent action before 'costs'")


@uses.register
def _(statement: syntax.InitiallyStatement) -> Iterator[Use]:
    yield Use(statement.fluent, FLUENTS, "a fluent before 'for some'")


@uses.register
def _(default: syntax.DefaultStatement) -> Iterator[Use]:
    yield Use(default.head.atom, frozenset({"inertial"}), "an inertial fluent as the conclusion")
    yield from body_uses(default.body)


@uses.register
def _(exception: syntax.ExceptionStatement) -> Iterator[Use]:
    yield from body_uses(exception.body)


@uses.register
def _(statement: syntax.TriggerStatement) -> Iterator[Use]:
    yield Use(statement.event, EXOGENOUS, "an exogenous action as the event")
    if statement.upon is not None:
        yield Use(statement.upon, AGENT, "an agent action after 'upon'")
    yield from body_uses(statement.pool)
    yield from body_uses(statement.body)


def scope(statement: syntax.Statement) -> Iterator[Use]:
    """The atoms that bind the statement's variables: its own, and those of its default."""
    if isinstance(statement, syntax.ExceptionStatement) and statement.of is not None:
        yield from uses(statement.of)
    yield from uses(statement)


def noun(kinds: frozenset[str]) -> str:
    """What a place for these kinds of symbols is for, in one word."""
    if kinds <= ACTIONS:
        return "action"
    return "static" if kinds == {"static"} else "fluent"


def body_uses(body: syntax.Body) -> Iterator[Use]:
    """The atoms of a body with their role."""
    for literal in literals(body):
        yield Use(literal.atom, DOMAIN | {SORT}, "a fluent, a static or a sort in a body")


def literals(body: Iterable[syntax.Condition]) -> Iterator[syntax.Literal]:
    return (condition for condition in body if isinstance(condition, syntax.Literal))


def comparisons(body: Iterable[syntax.Condition]) -> Iterator[syntax.Comparison]:
    return (condition for condition in body if isinstance(condition, syntax.Comparison))


def bodies(statement: syntax.Statement) -> Iterator[syntax.Condition]:
    """The conditions of all the bodies of a statement."""
    for field in ("body", "pool"):
        yield from getattr(statement, field, ())
