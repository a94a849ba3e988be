"""The checks that need the signature: symbols, arguments, variables, forbidden forms."""

from collections.abc import Iterable, Iterator

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


Mistakes = Iterator[tuple[syntax.Place, str]]


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
    names = {use.atom.name for use in roles.uses(statement)} - signature.sorts.keys()
    if not names <= signature.symbols.keys():
        return True
    return any(
        sort.name not in signature.sorts for name in names for sort in signature.symbols[name].sorts
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
    kind = _kind(atom.name, signature)
    if kind is None:
        if any(d.kind in use.kinds and len(d.sorts) == len(atom.args) for d in failed):
            return  # a declaration that failed may have been of this atom
        known = suggestion(
            atom.name, [n for n, d in signature.symbols.items() if d.kind in use.kinds]
        )
        yield atom.place, f"unknown {roles.noun(use.kinds)} '{atom.name}'; {known}"
    elif kind not in use.kinds:
        yield atom.place, f"'{atom.name}' is {_NOUNS[kind]}; this place needs {use.wanted}"
    else:
        yield from _of_arguments(atom, signature)


def _kind(name: str, signature: Signature) -> str | None:
    if name in signature.sorts:
        return roles.SORT
    declaration = signature.symbols.get(name)
    return None if declaration is None else declaration.kind


def _of_arguments(atom: syntax.Atom, signature: Signature) -> Mistakes:
    is_sort = atom.name in signature.sorts
    sorts = [atom.name] if is_sort else [s.name for s in signature.symbols[atom.name].sorts]
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
            kind = _kind(head.atom.name, signature)
            if kind == "static":
                yield from _of_static_law(statement, signature)
            if kind == "defined" and not head.positive:
                reason = "it is false unless derived, so it cannot stand negated in a head"
                yield statement.place, f"'{head.atom.name}' is defined: {reason}"
        case syntax.TriggerStatement(probability=probability) if not 0 <= probability <= 1:
            yield statement.place, "a probability lies between 0 and 1"
    for literal in roles.literals(roles.bodies(statement)):
        if literal.atom.name in signature.sorts and not literal.positive:
            yield literal.atom.place, "a sort in a body cannot be negated"


def _of_static_law(law: syntax.StateConstraint, signature: Signature) -> Mistakes:
    name = law.head.atom.name
    for atom in (literal.atom for literal in roles.literals(law.body)):
        if _kind(atom.name, signature) in roles.FLUENTS:
            yield atom.place, f"the static '{name}' cannot depend on the fluent '{atom.name}'"
    if not law.head.positive:
        yield law.place, "a static is false unless derived; drop the negation"


def _of_variables(statement: syntax.Statement, signature: Signature) -> Mistakes:
    places = [
        (term.name, members)
        for use in roles.scope(statement)
        for term, members in zip(use.atom.args, roles.places_of(use.atom, signature), strict=True)
    ]
    bound = {name for name, _ in places}
    of_no_member = {name for name, members in places if not members}  # another mistake is to blame
    for name, members in roles.variable_domains(statement, signature).items():
        if not members and name in bound - of_no_member:
            yield statement.place, f"no constant fits all the places of variable {name}"
    beside = [getattr(statement, field, None) for field in ("drawn", "variable", "robot")]
    for comparison in roles.comparisons(roles.bodies(statement)):
        beside += (comparison.left, comparison.right)
    for term in {term.name: term for term in reversed(beside) if term is not None}.values():
        if term.is_variable and term.name not in bound:
            where = "it stands in no fluent, static or action"
            yield term.place, f"variable {term.name} is bound by nothing: {where}"
        elif not term.is_variable and term.name not in signature.constants:
            known = suggestion(term.name, signature.constants)
            yield term.place, f"unknown constant '{term.name}'; {known}"
