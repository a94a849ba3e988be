"""Kinds of symbols by their place in a statement, and the domains of variables."""

from collections.abc import Iterable, Iterator, Mapping

from asp.language import syntax
from asp.language.signature import Signature

INERTIAL = frozenset({"inertial"})
FLUENTS = frozenset({"inertial", "defined"})
DOMAIN = FLUENTS | {"static"}
AGENT = frozenset({"agent"})
EXOGENOUS = frozenset({"exogenous"})
ACTIONS = AGENT | EXOGENOUS
SORT = "sort"
Domains = Mapping[str, tuple[str, ...]]
"""The domain of each variable of one statement."""


class Use(syntax.Node):
    """An atom of a statement with the kinds of symbols that may stand there."""

    atom: syntax.Atom
    kinds: frozenset[str]
    wanted: str


Role = tuple[frozenset[str], str]

ROLES: dict[type[syntax.Statement], dict[str, Role]] = {
    syntax.CausalLaw: {
        "action": (ACTIONS, "an action before 'causes'"),
        "head": (INERTIAL, "an inertial fluent as the effect"),
    },
    syntax.StateConstraint: {"head": (DOMAIN, "a fluent or a static as the head")},
    syntax.ExecutabilityCondition: {"actions": (ACTIONS, "an action after 'impossible'")},
    syntax.Fact: {"literal": (frozenset({"static"}), "a static as a fact")},
    syntax.SeesStatement: {"fluent": (FLUENTS, "a fluent after 'sees'")},
    syntax.ShowsStatement: {
        "action": (AGENT, "an agent action before 'shows'"),
        "fluent": (FLUENTS, "a fluent after 'shows'"),
    },
    syntax.CostStatement: {"action": (AGENT, "an agent action before 'costs'")},
    syntax.InitiallyStatement: {"fluent": (FLUENTS, "a fluent before 'for some'")},
    syntax.DefaultStatement: {"head": (INERTIAL, "an inertial fluent as the conclusion")},
    syntax.TriggerStatement: {
        "event": (EXOGENOUS, "an exogenous action as the event"),
        "upon": (AGENT, "an agent action after 'upon'"),
    },
}
"""The kinds of symbols that may stand in a field of a statement, beside its bodies."""
_IN_BODIES = DOMAIN | {SORT}, "a fluent, a static or a sort in a body"
_IN_TRIGGERS = DOMAIN | {SORT} | AGENT, "a fluent, a static, a sort or an agent action in a body"


def uses(statement: syntax.Statement) -> Iterator[Use]:
    """Every atom of the statement with its role; none in sorts and declarations."""
    for field, (kinds, wanted) in ROLES.get(type(statement), {}).items():
        value = getattr(statement, field)
        for part in value if isinstance(value, tuple) else (value,):
            if part is not None:
                atom = part.atom if isinstance(part, syntax.Literal) else part
                yield Use(atom, kinds, wanted)
    in_bodies = _IN_TRIGGERS if isinstance(statement, syntax.TriggerStatement) else _IN_BODIES
    for literal in literals(bodies(statement)):
        yield Use(literal.atom, *in_bodies)


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


def literals(body: Iterable[syntax.Condition]) -> Iterator[syntax.Literal]:
    return (condition for condition in body if isinstance(condition, syntax.Literal))


def comparisons(body: Iterable[syntax.Condition]) -> Iterator[syntax.Comparison]:
    return (condition for condition in body if isinstance(condition, syntax.Comparison))


def bodies(statement: syntax.Statement) -> Iterator[syntax.Condition]:
    """The conditions of all the bodies of a statement."""
    for drawing in getattr(statement, "drawings", ()):
        yield from drawing.pool
    yield from getattr(statement, "body", ())


def default_atom(default: syntax.DefaultStatement, signature: Signature) -> syntax.Atom:
    """The name of a default, with its variables: an instance of it is named by their values."""
    variables = variable_domains(default, signature)
    terms = tuple(syntax.Term(variable, default.place) for variable in variables)
    return syntax.Atom(default.name, terms, default.place)


def variable_domains(statement: syntax.Statement, signature: Signature) -> Domains:
    """The members that each variable may take: common to the sorts of all its places."""
    domains: dict[str, tuple[str, ...]] = {}
    for term, sort in places(statement, signature):
        if term.is_variable:
            members = signature.sorts[sort]
            found = domains.setdefault(term.name, members)
            if found is not members:
                common = set(members)
                domains[term.name] = tuple(each for each in found if each in common)
    if isinstance(statement, syntax.SeesStatement) and statement.robot.is_variable:
        domains.setdefault(statement.robot.name, ())
    return domains


def places(statement: syntax.Statement, signature: Signature) -> Iterator[tuple[syntax.Term, str]]:
    """The arguments of the atoms in scope, each with the sort of its place."""
    for use in scope(statement):
        yield from zip(use.atom.args, signature.sorts_of(use.atom.name), strict=True)
