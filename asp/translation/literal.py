"""The translation of AL_d to answer set programs (D 2.2): one rule a law, in source order.

The program speaks of steps `0..n`: `holds(F,I)`, `-holds(F,I)`, `occurs(A,I)`, `impossible(A,I)`.
What a robot sees, what actions show and cost, and the scenarios are no part of the transition
diagram; they stay out of it. Defaults are told, as `default(D,F,B)` and `stated_exception(D)`, and
bind nobody: what they do is up to the theory of defaults.
"""

from __future__ import annotations

from itertools import chain, count

from asp.language import Signature, analyse, ground, syntax, variable_domains
from asp.language import variable_sorts as roles
from asp.solving import theory
from asp.translation.rules import condition, rule, schema, term_text

_HEADER = """\
% Steps 0 to n; `-c n=K` on clingo's command line sets another horizon.
#const n = 1.
step(0..n)."""


def translate(text: str, file: str = "<text>") -> str:
    """The program of an AL_d text. Raises SourceError."""
    return translate_source(*analyse(text, file))


def translate_source(source: syntax.Source, signature: Signature) -> str:
    """The program of a checked description."""
    writer = _Writer(source)
    for statement in source.statements:
        writer.write(statement, _rules(statement, signature))
    theories = theory("transitions").rstrip(), theory("awareness")
    sections = [_HEADER, writer.text(), _signature_rules(signature), *theories]
    return "\n\n".join(section for section in sections if section)


class _Writer:
    """Puts the source's comments back where they stood: above a statement, or behind it."""

    def __init__(self, source: syntax.Source) -> None:
        self._pending = list(source.comments)
        self._lines: list[str] = []
        self._last = 0

    def write(self, statement: syntax.Statement, rules: list[str]) -> None:
        above = self._comments_until(statement.place.line - 1)
        behind = self._comments_until(statement.last_line)
        if not rules:
            return
        if self._lines and (above or statement.place.line > self._last + 1):
            self._lines.append("")
        self._lines += above + rules
        if behind:
            self._lines[-1] += "  " + " ".join(behind)
        self._last = statement.last_line

    def text(self) -> str:
        return "\n".join(self._lines)

    def _comments_until(self, line: int) -> list[str]:
        taken = [_comment(c.text) for c in self._pending if c.line <= line]
        self._pending = [c for c in self._pending if c.line > line]
        return taken


def _comment(text: str) -> str:
    """The comment as a line of ASP, where `%*` would open a comment of many lines."""
    line = "".join(c if c.isprintable() else " " for c in text)
    return line.replace("%*", "% *", 1) if line.startswith("%*") else line


def _rules(statement: syntax.Statement, signature: Signature) -> list[str]:
    match statement:
        case syntax.SortDefinition(name=name, parts=parts):
            return [_sort_rule(name, part) for part in parts]
        case syntax.Declaration():
            return [] if statement.kind == "static" else [_declaration(statement)]
        case syntax.Fact(literal=literal):
            return [f"{term_text(literal.atom)}."]
        case syntax.CausalLaw() | syntax.StateConstraint() | syntax.ExecutabilityCondition():
            return [_law(statement, signature)]
        case syntax.DefaultStatement() | syntax.ExceptionStatement():
            return [_default(statement, signature)]
        case _:
            return []


def _sort_rule(name: str, part: syntax.Term | tuple[syntax.Term, ...]) -> str:
    if isinstance(part, tuple):
        return f"{name}({'; '.join(constant.name for constant in part)})."
    return f"{name}(X) :- {part.name}(X)."


def _declaration(declaration: syntax.Declaration) -> str:
    predicate = declaration.kind + ("_action" if declaration.kind in roles.ACTIONS else "")
    term, _, sorts = schema(declaration)
    return rule(f"{predicate}({term})", sorts)


def _law(law: syntax.Statement, signature: Signature) -> str:
    i = _step_variable(law, signature)
    sorts = [f"{sort}({v})" for v, sort in _narrowest_sorts(law, signature)]
    body = [condition(c, signature, i) for c in roles.bodies(law)]
    match law:
        case syntax.CausalLaw(action=action, head=head):
            occurs = f"occurs({term_text(action)},{i})"
            return rule(_holds(head, f"{i}+1"), [occurs, *body, *sorts, f"step({i})", f"{i} < n"])
        case syntax.StateConstraint(head=head) if _is_static(head, signature):
            return rule(term_text(head.atom), [*body, *sorts])
        case syntax.StateConstraint(head=head):
            return rule(_holds(head, i), [*body, *sorts, f"step({i})"])
        case syntax.ExecutabilityCondition(actions=(action,)):
            return rule(f"impossible({term_text(action)},{i})", [*body, *sorts, f"step({i})"])
        case syntax.ExecutabilityCondition(actions=actions):
            together = [f"occurs({term_text(action)},{i})" for action in actions]
            return rule("", [*together, *body, *sorts, f"step({i})"])
    raise TypeError(f"{type(law).__name__} is not a law")


def _default(
    statement: syntax.DefaultStatement | syntax.ExceptionStatement, signature: Signature
) -> str:
    """default(D,F,B), or that a stated exception to D applies, in the state at step 0."""
    body = [condition(c, signature, "0") for c in statement.body]
    body += [f"{sort}({v})" for v, sort in _narrowest_sorts(statement, signature)]
    if isinstance(statement, syntax.ExceptionStatement):
        assert statement.of is not None, "the checker has found every default"
        return rule(f"stated_exception({_default_name(statement.of, signature)})", body)
    head, truth = statement.head, "true" if statement.head.positive else "false"
    name = _default_name(statement, signature)
    return rule(f"default({name},{term_text(head.atom)},{truth})", body)


def _default_name(default: syntax.DefaultStatement, signature: Signature) -> str:
    return ground(default.name, variable_domains(default, signature))


def _step_variable(law: syntax.Statement, signature: Signature) -> str:
    """`I`, or where the law has a variable of that name `I1`, `I2`, ..."""
    taken = variable_domains(law, signature)
    return next(name for name in chain(["I"], map("I{}".format, count(1))) if name not in taken)


def _holds(literal: syntax.Literal, step: str) -> str:
    return f"{'' if literal.positive else '-'}holds({term_text(literal.atom)},{step})"


def _is_static(literal: syntax.Literal, signature: Signature) -> bool:
    return signature.symbols[literal.atom.name].kind == "static"


def _narrowest_sorts(statement: syntax.Statement, signature: Signature) -> list[tuple[str, str]]:
    """Each variable with the sorts that say what it ranges over, wider ones left out."""
    found: list[tuple[str, str]] = []
    for variable in variable_domains(statement, signature):
        names = list(dict.fromkeys(_sorts_of(variable, statement, signature)))
        members = {name: set(signature.sorts[name]) for name in names}
        found += (
            (variable, name)
            for number, name in enumerate(names)
            if not any(
                members[other] < members[name]
                or (members[other] == members[name] and names.index(other) < number)
                for other in names
                if other != name
            )
        )
    return found


def _sorts_of(variable: str, statement: syntax.Statement, signature: Signature) -> list[str]:
    return [
        sort
        for use in roles.scope(statement)
        if use.atom.name not in signature.sorts
        for term, sort in zip(
            use.atom.args,
            (s.name for s in signature.symbols[use.atom.name].sorts),
            strict=True,
        )
        if term.name == variable
    ]


def _signature_rules(signature: Signature) -> str:
    """Closed world for statics; predicates that nothing declares are defined all the same."""
    lines = ["% Closed world for statics."]
    for declaration in signature.symbols.values():
        if declaration.kind == "static":
            atom, _, sorts = schema(declaration)
            lines.append(rule(f"-{atom}", [*sorts, f"not {atom}"]))
    defined = "#defined inertial/1. #defined defined/1.\n"
    defined += "#defined agent_action/1. #defined exogenous_action/1.\n"
    defined += "#defined occurs/2. #defined impossible/2."
    return "\n".join(lines) + f"\n\n{defined}"
