"""Whether every action has one outcome: by the form of the laws, else by a search of all states."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterable
from dataclasses import dataclass

from clingo import Symbol
from clingo.ast import AST, ASTType, Transformer, parse_string

from asp.language import Action, Description, Literal, reachable
from asp.solving import Limits, State, deciding, fact, first_model, ground, literal_of, select

LIMITS = Limits(conflicts=200_000, ground_rules=2_000_000)
"""What the search may take."""

_Node = tuple[Literal, bool]
"""A literal of the next state, and whether it is new: it was false before."""

# Two copies of the program agree on the first state and on the action, if any. No name of a
# description has an apostrophe.
_TWICE = """
{ occurs(A,0) : action(A) } 1.
:- holds(F,0), not holds'(F,0).
:- holds'(F,0), not holds(F,0).
acts' :- occurs(A,0).
branches' :- acts', holds(F,1), not holds'(F,1).
changes'  :- not acts', holds(F,1), not holds(F,0).
changes'  :- not acts', holds(F,0), not holds(F,1).
#show occurs(A) : occurs(A,0).
#show before(F) : holds(F,0).
#show after(F) : holds(F,1).
#show other(F) : holds'(F,1).
"""


@dataclass(frozen=True)
class Branching:
    """A state in which an action has two outcomes, or in which doing nothing has another one.

    `action` is None, and there is one outcome, where nothing is done.
    """

    state: State
    action: Action | None
    outcomes: tuple[State, ...]


def branchings(description: Description, program: str) -> list[Branching]:
    """At most one witness each of an action with several outcomes and of a state that changes.

    Every state and every single action is looked at, whatever the size of the diagram; `program` is
    the translation of the description. Raises LimitError where that takes more than `LIMITS`.
    """
    if deterministic_by_form(description):
        return []
    with deciding(LIMITS):
        control = ground([program, _other_copy(program), _TWICE], {"n": 1}, ())
        kinds = ((fact(kind), True) for kind in ("branches'", "changes'"))
        models = (first_model(control, [kind]) for kind in kinds)
        return [_witness(model) for model in models if model is not None]


def deterministic_by_form(description: Description) -> bool:
    """Whether the form of the laws alone shows that every compound action has one outcome.

    Linear in the laws, and sound: where it is False there may be one outcome all the same. A
    literal of the next state about an inertial fluent is old if it was true before, and then holds
    unless its complement is derived; else it is new, and needs a law with a new literal in its
    body, for the state before was closed. What is defined is derived anew. A new literal removes
    the old one that contradicts it, and a defined fluent its own negation: where no literal
    depends in a circle on what it removes in this way, the program of the next state is
    stratified, so that it has one answer set at most.
    """
    defined = frozenset(description.defined)
    new = _new(description, defined)
    graph: defaultdict[_Node, set[_Node]] = defaultdict(set)
    for law in description.constraints:
        if law.head in new:
            for literal in law.body:
                others = (other for other in law.body if other != literal)
                may_be_old = law.head in defined or not new.isdisjoint(others)
                if literal in new:
                    graph[literal, True].add((law.head, True))
                if literal.atom not in defined and may_be_old:
                    graph[literal, False].add((law.head, True))
    removals: list[tuple[_Node, _Node]] = []
    for literal in new:
        removed = literal.complement, literal.atom in defined
        if removed in graph and (literal.is_positive or literal.atom not in defined):
            removals.append(((literal, True), removed))
    for removing, removed in removals:
        graph[removing].add(removed)
    return not any(removing in reachable(removed, graph) for removing, removed in removals)


def _new(description: Description, defined: frozenset[Literal]) -> set[Literal]:
    """Literals that may hold in the next state though they did not before."""
    following: defaultdict[Literal, list[Literal]] = defaultdict(list)
    for law in description.constraints:
        for literal in law.body:
            following[literal].append(law.head)
    new = {law.head for law in description.causal}
    new |= {sign for fluent in defined for sign in (fluent, fluent.complement)}
    waiting = list(new)
    while waiting:
        heads = [head for head in following[waiting.pop()] if head not in new]
        new.update(heads)
        waiting += heads
    return new


class _OtherCopy(Transformer):
    """Renames the predicate `holds`, and no term that is called so."""

    def visit_SymbolicAtom(self, atom: AST) -> AST:  # noqa: N802 (clingo's name)
        if atom.symbol.ast_type == ASTType.UnaryOperation:
            return atom.update(symbol=atom.symbol.update(argument=_other(atom.symbol.argument)))
        return atom.update(symbol=_other(atom.symbol))


def _other(atom: AST) -> AST:
    is_holds = atom.ast_type == ASTType.Function and atom.name == "holds"
    return atom.update(name="holds'") if is_holds else atom


def _other_copy(program: str) -> str:
    """The program about other states, with the same actions."""
    statements: list[AST] = []
    parse_string(program, statements.append)
    return "\n".join(str(_OtherCopy().visit(statement)) for statement in statements)


def _witness(model: Iterable[Symbol]) -> Branching:
    atoms = {
        name: [literal_of(symbol) for (symbol,) in select(model, name, 1)]
        for name in ("occurs", "before", "after", "other")
    }
    before, after, other = (frozenset(atoms[name]) for name in ("before", "after", "other"))
    action = next(iter(atoms["occurs"]), None)
    return Branching(before, action, (after,) if action is None else (after, other))
