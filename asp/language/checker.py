"""The checks that need the signature: symbols, arguments, variables, forbidden forms."""

from __future__ import annotations

from collections.abc import Iterable

from asp.language import syntax
from asp.language import variable_sorts as roles
from asp.language.errors import Problems, suggestion
from asp.language.signature import Signature, is_reserved_constant, report_reserved
from asp.language.variable_sorts import places_of, variable_domains


def check(source: syntax.Source, signature: Signature, problems: Problems) -> None:
    """Reports every mistake in the statements of a description."""
    faulty: set[syntax.Statement | None] = {None}
    for statement in source.statements:
        found = len(problems)
        for use in roles.uses(statement):
            _check_use(use, signature, problems)
        _check_form(statement, signature, problems)
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


def _may_be_meant(use: roles.Use, failed: Iterable[syntax.Declaration]) -> bool:
    """Whether a declaration that failed may have been of this atom."""
    return any(d.kind in use.kinds and len(d.sorts) == len(use.atom.args) for d in failed)


def _check_defaults(source: syntax.Source, problems: Problems) -> None:
    lines: dict[str, int] = {}
    for default in source.each(syntax.DefaultStatement):
        if default.name in lines:
            first = f"first in line {lines[default.name]}"
            problems.report(default.place, f"two defaults have the name '{default.name}'; {first}")
        if is_reserved_constant(default.name):
            report_reserved(default.name, default.place, problems)
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
        if quiet.scenario in lines:
            line = lines[quiet.scenario]
            problems.report(
                quiet.place, f"in scenario '{quiet.scenario}' something happens; see line {line}"
            )


def _check_use(use: roles.Use, signature: Signature, problems: Problems) -> None:
    atom = use.atom
    kind = _kind(atom.name, signature)
    if kind is None:
        if _may_be_meant(use, problems.failed):
            return
        known = [n for n, d in signature.symbols.items() if d.kind in use.kinds]
        noun = roles.noun(use.kinds)
        problems.report(atom.place, f"unknown {noun} '{atom.name}'; {suggestion(atom.name, known)}")
    elif kind not in use.kinds:
        problems.report(
            atom.place, f"'{atom.name}' is {_noun(kind)}; this place needs {use.wanted}"
        )
    else:
        _check_arguments(atom, signature, problems)


def _kind(name: str, signature: Signature) -> str | None:
    if name in signature.sorts:
        return roles.SORT
    declaration = signature.symbols.get(name)
    return None if declaration is None else declaration.kind


def _noun(kind: str) -> str:
    return {
        "sort": "a sort",
        "static": "a static",
        "inertial": "an inertial fluent",
        "defined": "a defined fluent",
        "agent": "an agent action",
        "exogenous": "an exogenous action",
    }[kind]


def _check_arguments(atom: syntax.Atom, signature: Signature, problems: Problems) -> None:
    sorts = (
        [atom.name]
        if atom.name in signature.sorts
        else [sort.name for sort in signature.symbols[atom.name].sorts]
    )
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
            problems.report(
                term.place,
                f"'{term.name}' is not of sort '{sort}'; {suggestion(term.name, members)}",
            )


def _check_form(statement: syntax.Statement, signature: Signature, problems: Problems) -> None:
    if isinstance(statement, syntax.Fact) and not statement.literal.positive:
        problems.report(statement.place, "a fact is positive; what is not stated is false")
    if isinstance(statement, syntax.StateConstraint):
        _check_constraint(statement, signature, problems)
    if isinstance(statement, syntax.TriggerStatement) and not 0 <= statement.probability <= 1:
        problems.report(statement.place, "a probability lies between 0 and 1")
    for literal in roles.literals(roles.bodies(statement)):
        if literal.atom.name in signature.sorts and not literal.positive:
            problems.report(literal.atom.place, "a sort in a body cannot be negated")


def _check_constraint(
    law: syntax.StateConstraint, signature: Signature, problems: Problems
) -> None:
    kind = _kind(law.head.atom.name, signature)
    if kind == "defined" and not law.head.positive:
        problems.report(
            law.place,
            f"'{law.head.atom.name}' is defined: it is false unless derived, "
            "so it cannot stand negated in a head",
        )
    if kind == "static":
        for literal in roles.literals(law.body):
            if _kind(literal.atom.name, signature) in roles.FLUENTS:
                problems.report(
                    literal.atom.place,
                    f"the static '{law.head.atom.name}' cannot depend on the fluent "
                    f"'{literal.atom.name}'",
                )
        if not law.head.positive:
            problems.report(law.place, "a static is false unless derived; drop the negation")


def _check_variables(statement: syntax.Statement, signature: Signature, problems: Problems) -> None:
    domains = variable_domains(statement, signature)
    for name, members in domains.items():
        if not members and not _may_be_empty(statement, name, signature):
            problems.report(statement.place, f"no constant fits all the places of variable {name}")
    for comparison in roles.comparisons(roles.bodies(statement)):
        for term in (comparison.left, comparison.right):
            if term.is_variable and term.name not in domains:
                _report_unbound(term, problems)
            elif not term.is_variable:
                _check_constant(term, signature, problems)
    for field in ("drawn", "variable", "robot"):
        named = getattr(statement, field, None)
        if named is not None:
            _check_named(named, statement, signature, problems)


def _check_named(
    term: syntax.Term, statement: syntax.Statement, signature: Signature, problems: Problems
) -> None:
    if term.is_variable and _stands_nowhere(statement, term.name):
        _report_unbound(term, problems)
    elif not term.is_variable:
        _check_constant(term, signature, problems)


def _check_constant(term: syntax.Term, signature: Signature, problems: Problems) -> None:
    if term.name not in signature.constants:
        known = suggestion(term.name, signature.constants)
        problems.report(term.place, f"unknown constant '{term.name}'; {known}")


def _stands_nowhere(statement: syntax.Statement, variable: str) -> bool:
    """Whether a variable of a comparison, or named beside the atoms, stands in no atom."""
    return not any(
        term.name == variable for use in roles.scope(statement) for term in use.atom.args
    )


def _may_be_empty(statement: syntax.Statement, name: str, signature: Signature) -> bool:
    """Whether another mistake is to blame: a sort without members, or a place in no atom."""
    return _stands_nowhere(statement, name) or any(
        term.name == name and not members
        for use in roles.scope(statement)
        for term, members in zip(use.atom.args, places_of(use.atom, signature), strict=True)
    )


def _report_unbound(term: syntax.Term, problems: Problems) -> None:
    problems.report(
        term.place,
        f"variable {term.name} is bound by nothing: it stands in no fluent, static or action",
    )
