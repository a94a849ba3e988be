"""The checks that need the signature: symbols, arguments, variables, forms, definitions."""

from collections import defaultdict
from collections.abc import Hashable, Iterable, Iterator, Mapping, Sequence
from typing import TypeVar

from asp.language import syntax
from asp.language import variable_sorts as roles
from asp.language.errors import Problems, suggestion
from asp.language.grounding import Instances, instance, static_truth
from asp.language.literals import Literal
from asp.language.signature import Signature, check_reserved

T = TypeVar("T", bound=Hashable)
Mistakes = Iterator[tuple[syntax.Place, str]]
Law = tuple[syntax.StateConstraint, Literal, Iterable[Literal]]
"""A state constraint with the head and the body of an instance, or with their names alone."""

_NOUNS = {
    roles.SORT: "a sort",
    "static": "a static",
    "inertial": "an inertial fluent",
    "defined": "a defined fluent",
    "agent": "an agent action",
    "exogenous": "an exogenous action",
}


def check(source: syntax.Source, signature: Signature, problems: Problems) -> None:
    """Reports every mistake in the statements of a description."""
    faulty: set[syntax.Statement | None] = {None}
    for statement in source.statements:
        found = [*_of_form(statement, signature)]
        for use in roles.uses(statement):
            found += _of_use(use, signature, problems.failed)
        problems.report_all(found)
        if found or _uses_unknown(statement, signature):
            faulty.add(statement)
    for default in source.each(syntax.DefaultStatement):
        check_reserved(default.name, "constant", default.place, problems)
    problems.report_all(_of_defaults(source))
    problems.report_all(_of_scenarios(source))
    for statement in source.statements:
        default_of = getattr(statement, "of", statement)
        if statement not in faulty and default_of not in faulty:
            problems.report_all(_of_variables(statement, signature))


def _uses_unknown(statement: syntax.Statement, signature: Signature) -> bool:
    """Whether an atom's declaration is in error, so that no more can be said of its places."""
    names = {use.atom.name for use in roles.uses(statement)}
    return any(
        signature.kind(name) is None or not signature.sorts.keys() >= {*signature.sorts_of(name)}
        for name in names
    )


def _of_defaults(source: syntax.Source) -> Mistakes:
    known: dict[str, syntax.DefaultStatement] = {}
    for default in source.each(syntax.DefaultStatement):
        first = known.setdefault(default.name, default)
        if first is not default:
            line = f"first in line {first.place.line}"
            yield default.place, f"two defaults have the name '{default.name}'; {line}"
    for exception in source.each(syntax.ExceptionStatement):
        if exception.of is None:
            meant = suggestion(exception.name, known)
            yield exception.place, f"unknown default '{exception.name}'; {meant}"


def _of_scenarios(source: syntax.Source) -> Mistakes:
    lines = {event.scenario: event.place.line for event in source.each(syntax.TriggerStatement)}
    for quiet in source.each(syntax.QuietStatement):
        if line := lines.get(quiet.scenario):
            message = f"in scenario '{quiet.scenario}' something happens; see line {line}"
            yield quiet.place, message


def _of_use(use: roles.Use, signature: Signature, failed: Iterable[syntax.Declaration]) -> Mistakes:
    atom = use.atom
    kind = signature.kind(atom.name)
    if kind is None:
        if any(d.kind in use.kinds and len(d.sorts) == len(atom.args) for d in failed):
            return  # a declaration that failed may have been of this atom
        alike = [name for name, symbol in signature.symbols.items() if symbol.kind in use.kinds]
        meant = suggestion(atom.name, alike)
        yield atom.place, f"unknown {roles.noun(use.kinds)} '{atom.name}'; {meant}"
    elif kind not in use.kinds:
        yield atom.place, f"'{atom.name}' is {_NOUNS[kind]}; this place needs {use.wanted}"
    else:
        yield from _of_arguments(atom, signature)


def _of_arguments(atom: syntax.Atom, signature: Signature) -> Mistakes:
    sorts = signature.sorts_of(atom.name)
    if len(sorts) != len(atom.args):
        form = f"{atom.name}({', '.join(sorts)})" if sorts else atom.name
        count = f"{len(sorts)} argument(s), not {len(atom.args)}"
        yield atom.place, f"'{atom.name}' takes {count}: {form}"
        return
    for term, sort in zip(atom.args, sorts, strict=True):
        members = signature.sorts.get(sort, ())
        if not term.is_variable and members and term.name not in members:
            known = suggestion(term.name, members)
            yield term.place, f"'{term.name}' is not of sort '{sort}'; {known}"


def _of_form(statement: syntax.Statement, signature: Signature) -> Mistakes:
    match statement:
        case syntax.Fact(literal=literal) if not literal.positive:
            yield statement.place, "a fact is positive; what is not stated is false"
        case syntax.StateConstraint(head=head):
            kind = signature.kind(head.atom.name)
            if kind == "static":
                yield from _of_static_law(statement, signature)
            if kind == "defined" and not head.positive:
                reason = "it is false unless derived, so it cannot stand negated in a head"
                yield statement.place, f"'{head.atom.name}' is defined: {reason}"
        case syntax.TriggerStatement(probability=probability) if not 0 <= probability <= 1:
            yield statement.place, "a probability lies between 0 and 1"
        case syntax.TriggerStatement(drawings=drawings):
            variables = [drawing.variable for drawing in drawings]
            for number, variable in enumerate(variables):
                if variable.name in (earlier.name for earlier in variables[:number]):
                    yield variable.place, f"variable {variable.name} is drawn already; drop one"
    for literal in roles.literals(roles.bodies(statement)):
        if literal.atom.name in signature.sorts and not literal.positive:
            yield literal.atom.place, "a sort in a body cannot be negated"


def _of_static_law(law: syntax.StateConstraint, signature: Signature) -> Mistakes:
    name = law.head.atom.name
    for atom in (literal.atom for literal in roles.literals(law.body)):
        if signature.kind(atom.name) in roles.FLUENTS:
            yield atom.place, f"the static '{name}' cannot depend on the fluent '{atom.name}'"
    if not law.head.positive:
        yield law.place, "a static is false unless derived; drop the negation"


def _of_variables(statement: syntax.Statement, signature: Signature) -> Mistakes:
    bound = {term.name for term, _ in roles.places(statement, signature)}
    of_no_member = {  # another mistake is to blame
        term.name for term, sort in roles.places(statement, signature) if not signature.sorts[sort]
    }
    for name, members in roles.variable_domains(statement, signature).items():
        if not members and name in bound - of_no_member:
            yield statement.place, f"no constant fits all the places of variable {name}"
    beside = [getattr(statement, field, None) for field in ("variable", "robot")]
    beside += [drawing.variable for drawing in getattr(statement, "drawings", ())]
    for comparison in roles.comparisons(roles.bodies(statement)):
        beside += comparison.terms
    for term in {term.name: term for term in reversed(beside) if term is not None}.values():
        if term.is_variable and term.name not in bound:
            where = "it stands in no fluent, static or action"
            yield term.place, f"variable {term.name} is bound by nothing: {where}"
        elif not term.is_variable and term.name not in signature.constants:
            known = suggestion(term.name, signature.constants)
            yield term.place, f"unknown constant '{term.name}'; {known}"


def check_cycles(source: syntax.Source, signature: Signature, problems: Problems) -> None:
    """Reports each state constraint that closes a cycle through negation.

    A state constraint with a positive head defines that fluent. Where such definitions run in a
    cycle with a negated body literal on it (`p if -p`, or `p if -q` with `q if -p`), the
    description says no longer which states there are, and AL_d forbids it. A defined fluent, which
    is false where nothing derives it, can also depend on its own negation by way of negative
    literals (`d if -p` with `-p if -d`).
    """
    laws = list(source.each(syntax.StateConstraint))
    # Where the names alone close no cycle the instances, which larger sorts have more of, do not.
    by_name = [(law, _named(law.head), [*map(_named, roles.literals(law.body))]) for law in laws]
    if not any(_closing(by_name, signature)):
        return
    statics, open_statics = static_truth(source, signature)
    undecided = {static.name for static in open_statics}
    for law in laws:
        if (name := law.head.atom.name) in undecided:
            problems.report(law.place, f"'{name}' is defined through its own negation")
    ground = [
        (law, instance(law.head, binding), left["body"])
        for law in laws
        for binding, left in Instances(source, signature, statics).of(law)
    ]
    told: dict[syntax.Place, str] = {}
    for law, head, condition in _closing(ground, signature):
        message = f"'{head}' is defined through its own negation by way of '{condition}'"
        told.setdefault(law.place, message)
    problems.report_all(told.items())


def _named(literal: syntax.Literal) -> Literal:
    return Literal.of(literal.atom.name, (), literal.positive)


def _closing(
    laws: Sequence[Law], signature: Signature
) -> Iterator[tuple[syntax.StateConstraint, Literal, Literal]]:
    """The laws with a condition that makes the head depend on its own negation, and these two."""
    atoms: dict[Literal, set[Literal]] = defaultdict(set)
    literals: dict[Literal, set[Literal]] = defaultdict(set)
    for _, head, body in laws:
        literals[head].update(body)
        if head.is_positive:
            atoms[head].update(condition.atom for condition in body)
            if signature.kind(head.name) == "defined":
                literals[head.complement].add(head)
    for law, head, body in laws:
        is_defined = signature.kind(head.name) == "defined"
        for condition in body if head.is_positive else ():
            through_atoms = not condition.is_positive and head in reachable(condition.atom, atoms)
            if through_atoms or (is_defined and head.complement in reachable(condition, literals)):
                yield law, head, condition


def reachable(start: T, graph: Mapping[T, set[T]]) -> set[T]:
    """The nodes to which the arcs of a graph lead from one of them, itself included."""
    found, stack = {start}, [start]
    while stack:
        new = graph.get(stack.pop(), set()) - found
        found |= new
        stack += new
    return found
