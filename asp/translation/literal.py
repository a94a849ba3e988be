"""The translation of AL_d to answer set programs (D 2.2): one rule per law, in source order.

The program speaks of steps `0..n`: `holds(F,I)`, `-holds(F,I)`, `occurs(A,I)`, `impossible(A,I)`.
What a robot sees, what actions show and cost, and the scenarios are no part of the transition
diagram; they stay out of it. Defaults are told, as `default(D,F,B)` and `stated_exception(D)`, and
bind nobody: what they do is up to the theory of defaults.
"""

from itertools import chain, count

from asp.language import Signature, analyse, syntax, variable_domains
from asp.language import variable_sorts as roles
from asp.solving import theory
from asp.translation.rules import condition, rule, schema, sorts_of_variables

_HEADER = """\
% Steps 0 to n; `-c n=K` on clingo's command line sets another horizon.
#const n = 1.
step(0..n)."""
_DEFINED = """\
#defined inertial/1. #defined defined/1.
#defined agent_action/1. #defined exogenous_action/1.
#defined occurs/2. #defined impossible/2."""


def translate(text: str, file: str = "<text>") -> str:
    """The program of an AL_d text. Raises SourceError."""
    return translate_source(*analyse(text, file))


def translate_source(source: syntax.Source, signature: Signature) -> str:
    """The program of a checked description."""
    theories = theory("transitions").rstrip(), theory("awareness")
    sections = [_HEADER, _laid_out(source, signature), _signature_rules(signature), *theories]
    return "\n\n".join(section for section in sections if section)


def _laid_out(source: syntax.Source, signature: Signature) -> str:
    """The rules of the statements, with the comments where they stood: above, or behind."""
    lines: list[str] = []
    comments, last = list(source.comments), 0

    def comments_until(line: int) -> list[str]:
        number = sum(comment.line <= line for comment in comments)
        taken = [_comment(comment.text) for comment in comments[:number]]
        del comments[:number]
        return taken

    for statement in source.statements:
        above = comments_until(statement.place.line - 1)
        behind = comments_until(statement.last_line)
        if rules := _rules(statement, signature):
            if lines and (above or statement.place.line > last + 1):
                lines.append("")
            lines += above + rules
            if behind:
                lines[-1] += "  " + " ".join(behind)
            last = statement.last_line
    return "\n".join(lines)


def _comment(text: str) -> str:
    """The comment as a line of ASP, where `%*` would open a comment of many lines."""
    line = "".join(c if c.isprintable() else " " for c in text)
    return line.replace("%*", "% *", 1) if line.startswith("%*") else line


def _rules(statement: syntax.Statement, signature: Signature) -> list[str]:
    match statement:
        case syntax.SortDefinition(name=name, parts=parts):
            return [_sort_rule(name, part) for part in parts]
        case syntax.Declaration(kind=kind) if kind != "static":
            term, _, sorts = schema(statement)
            return [rule(f"{kind}{'_action' if kind in roles.ACTIONS else ''}({term})", sorts)]
        case syntax.Fact(literal=literal):
            return [rule(literal.atom, _narrowest_sorts(statement, signature))]
        case syntax.CausalLaw() | syntax.StateConstraint() | syntax.ExecutabilityCondition():
            return _law(statement, signature)
        case syntax.DefaultStatement() | syntax.ExceptionStatement():
            return [_default(statement, signature)]
    return []


def _sort_rule(name: str, part: syntax.Term | tuple[syntax.Term, ...]) -> str:
    if isinstance(part, tuple):
        return f"{name}({'; '.join(constant.name for constant in part)})."
    return f"{name}(X) :- {part.name}(X)."


def _law(
    law: syntax.CausalLaw | syntax.StateConstraint | syntax.ExecutabilityCondition,
    signature: Signature,
) -> list[str]:
    taken = variable_domains(law, signature)
    i = next(name for name in chain(["I"], map("I{}".format, count(1))) if name not in taken)
    body = [condition(part, signature, i) for part in law.body]
    body += _narrowest_sorts(law, signature)
    match law:
        case syntax.CausalLaw(action=action, head=head):
            effect = condition(head, signature, f"{i}+1")
            return [rule(effect, [f"occurs({action},{i})", *body, f"step({i})", f"{i} < n"])]
        case syntax.StateConstraint(head=head):
            static = signature.symbols[head.atom.name].kind == "static"
            return [rule(condition(head, signature, i), body if static else [*body, f"step({i})"])]
    first, *others = law.actions
    together = [f"occurs({action},{i})" for action in law.actions]
    rules = [rule("", [*together, *body, f"step({i})"])] if others else []
    if all(other.name == first.name for other in others):  # a compound action is a set
        same = [f"{first} = {other}" for other in others]
        rules.append(rule(f"impossible({first},{i})", [*same, *body, f"step({i})"]))
    return rules


def _default(
    statement: syntax.DefaultStatement | syntax.ExceptionStatement, signature: Signature
) -> str:
    """default(D,F,B), or that a stated exception to D applies, in the state at step 0."""
    body = [condition(part, signature, "0") for part in statement.body]
    body += _narrowest_sorts(statement, signature)
    default = statement.of if isinstance(statement, syntax.ExceptionStatement) else statement
    assert default is not None, "the checker has found every default"
    name = roles.default_atom(default, signature)
    if default is not statement:
        return rule(f"stated_exception({name})", body)
    truth = "true" if default.head.positive else "false"
    return rule(f"default({name},{default.head.atom},{truth})", body)


def _narrowest_sorts(statement: syntax.Statement, signature: Signature) -> list[str]:
    """`sort(V)` for the variables of a statement, wider sorts of a variable left out."""
    found: list[str] = []
    pairs = list(sorts_of_variables(statement, signature))
    for variable in variable_domains(statement, signature):
        names = [sort for name, sort in pairs if name == variable]
        members = [set(signature.sorts[name]) for name in names]
        found += (
            f"{name}({variable})"
            for number, (name, own) in enumerate(zip(names, members, strict=True))
            if not any(other < own for other in members) and own not in members[:number]
        )
    return found


def _signature_rules(signature: Signature) -> str:
    """Closed world for statics; predicates that nothing declares are defined all the same."""
    statics = map(schema, signature.of_kind("static"))
    lines = [rule(f"-{atom}", [*sorts, f"not {atom}"]) for atom, _, sorts in statics]
    return "\n".join(["% Closed world for statics.", *lines, "", _DEFINED])
