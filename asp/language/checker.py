"""The checks that need the signature: symbols, arguments, variables, forbidden forms."""

from __future__ import annotations

from collections.abc import Iterator

from asp.language import syntax
from asp.language import variable_sorts as roles
from asp.language.errors import Problems, suggestion
from asp.language.signature import Signature, check_reserved

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
        found = len(problems)
        for use in roles.uses(statement):
            _check_use(use, signature, problems)
        for place, message in _mistakes_of_form(statement, signature):
            problems.report(place, message)
        if len(problems) > found or _uses_unknown(statement, signature):
            faulty.add(statement)
    _check_defaults(source, problems)
    _check_scenarios(source, problems)
    for statement in source.statements:
        default = getattr(statement, "of", statement)
        if statement not in faulty and default not in faulty:
            _check_variables(statement, signature, problems)


def _uses_unknown(statement: syntax.Statement, signature: Signature) -> bool:
    """Whether an atom's declaration is in error, so that no more can be said of its places."""
    names = {use.atom.name for use in roles.uses(statement)} - signature.sorts.keys()
    if not names <= signature.symbols.keys():
        return True
    return any(
        sort.name not in signature.sorts for name in names for sort in signature.symbols[name].sorts
    )


def _check_defaults(source: syntax.Source, problems: Problems) -> None:
    lines: dict[str, int] = {}
    for default in source.each(syntax.DefaultStatement):
        if default.name in lines:
            first = f"first in line {lines[default.name]}"
            problems.report(default.place, f"two defaults have the name '{default.name}'; {first}")
        check_reserved(default.name, "constant", default.place, problems)
        lines.setdefault(default.name, default.place.line)
    for exception in source.each(syntax.ExceptionStatement):
        if exception.of is None:
            known = suggestion(exception.name, lines)
            problems.report(exception.place, f"unknown default '{exception.name}'; {known}")


def _check_scenarios(source: syntax.Source, problems: Problems) -> None:
    lines = {
        trigger.scenario: trigger.place.line for trigger in source.each(syntax.TriggerStatement)
    }
    for quiet in source.each(syntax.QuietStatement):
        if line := lines.get(quiet.scenario):
            problems.report(
                quiet.place, f"in scenario '{quiet.scenario}' something happens; see line {line}"
            )


def _check_use(use: roles.Use, signature: Signature, problems: Problems) -> None:
    atom = use.atom
    kind = _kind(atom.name, signature)
    if kind is None:
        if any(d.kind in use.kinds and len(d.sorts) == len(atom.args) for d in problems.failed):
            return  # a declaration that failed may have been of this atom
        known = [n for n, d in signature.symbols.items() if d.kind in use.kinds]
        message = f"unknown {roles.noun(use.kinds)} '{atom.name}'; {suggestion(atom.name, known)}"
        problems.report(atom.place, message)
    elif kind not in use.kinds:
        message = f"'{atom.name}' is {_NOUNS[kind]}; this place needs {use.wanted}"
        problems.report(atom.place, message)
    else:
        _check_arguments(atom, signature, problems)


def _kind(name: str, signature: Signature) -> str | None:
    if name in signature.sorts:
        return roles.SORT
    declaration = signature.symbols.get(name)
    return None if declaration is None else declaration.kind


def _check_arguments(atom: syntax.Atom, signature: Signature, problems: Problems) -> None:
    is_sort = atom.name in signature.sorts
    sorts = [atom.name] if is_sort else [s.name for s in signature.symbols[atom.name].sorts]
    if len(sorts) != len(atom.args):
        form = f"{atom.name}({', '.join(sorts)})" if sorts else atom.name
        problems.report(
            atom.place,
            f"'{atom.name}' takes {len(sorts)} argument(s), not {len(atom.args)}: {form}",
        )
        return
    for term, sort in zip(atom.args, sorts, strict=True):
        members = signature.sorts.get(sort, ())
        if not term.is_variable and members and term.name not in members:
            known = suggestion(term.name, members)
            problems.report(term.place, f"'{term.name}' is not of sort '{sort}'; {known}")


def _mistakes_of_form(
    statement: syntax.Statement, signature: Signature
) -> Iterator[tuple[syntax.Place, str]]:
    match statement:
        case syntax.Fact(literal=literal) if not literal.positive:
            yield statement.place, "a fact is positive; what is not stated is false"
        case syntax.StateConstraint(head=head):
            kind = _kind(head.atom.name, signature)
            if kind == "static":
                yield from _mistakes_of_static_law(statement, signature)
            if kind == "defined" and not head.positive:
                yield (
                    statement.place,
                    f"'{head.atom.name}' is defined: it is false unless derived, "
                    "so it cannot stand negated in a head",
                )
        case syntax.TriggerStatement(probability=probability) if not 0 <= probability <= 1:
            yield statement.place, "a probability lies between 0 and 1"
    for literal in roles.literals(roles.bodies(statement)):
        if literal.atom.name in signature.sorts and not literal.positive:
            yield literal.atom.place, "a sort in a body cannot be negated"


def _mistakes_of_static_law(
    law: syntax.StateConstraint, signature: Signature
) -> Iterator[tuple[syntax.Place, str]]:
    for atom in (literal.atom for literal in roles.literals(law.body)):
        if _kind(atom.name, signature) in roles.FLUENTS:
            yield (
                atom.place,
                f"the static '{law.head.atom.name}' cannot depend on the fluent '{atom.name}'",
            )
    if not law.head.positive:
        yield law.place, "a static is false unless derived; drop the negation"


def _check_variables(statement: syntax.Statement, signature: Signature, problems: Problems) -> None:
    places = [
        (term.name, members)
        for use in roles.scope(statement)
        for term, members in zip(use.atom.args, roles.places_of(use.atom, signature), strict=True)
    ]
    bound = {name for name, _ in places}
    of_no_member = {name for name, members in places if not members}  # another mistake is to blame
    for name, members in roles.variable_domains(statement, signature).items():
        if not members and name in bound - of_no_member:
            problems.report(statement.place, f"no constant fits all the places of variable {name}")
    beside = [getattr(statement, field, None) for field in ("drawn", "variable", "robot")]
    for comparison in roles.comparisons(roles.bodies(statement)):
        beside += (comparison.left, comparison.right)
    for term in {term.name: term for term in reversed(beside) if term is not None}.values():
        if term.is_variable and term.name not in bound:
            problems.report(
                term.place,
                f"variable {term.name} is bound by nothing: "
                "it stands in no fluent, static or action",
            )
        elif not term.is_variable and term.name not in signature.constants:
            known = suggestion(term.name, signature.constants)
            problems.report(term.place, f"unknown constant '{term.name}'; {known}")
