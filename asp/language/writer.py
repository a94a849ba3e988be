"""From abstract syntax back to AL_d text."""

from collections.abc import Mapping

from asp.language import syntax

_FORMS: Mapping[type, str] = {
    syntax.CausalLaw: "{action} causes {head}",
    syntax.StateConstraint: "{head}",
    syntax.ExecutabilityCondition: "impossible {actions}",
    syntax.Fact: "{literal}",
    syntax.SeesStatement: "{robot} sees {fluent}",
    syntax.ShowsStatement: "{action} shows {fluent}",
    syntax.InitiallyStatement: "{fluent} for some {variable}",
}
"""How statements are written, up to their bodies."""


def text_of(part: object) -> str:
    """A statement on one line, with its full stop; or a part of one, several with commas between.

    Raises TypeError for what is neither, and for kinds of statements that are not listed here.
    """
    match part:
        case syntax.Term(name=name):
            return name
        case syntax.Atom(name=name, args=args):
            return f"{name}({text_of(args)})" if args else name
        case syntax.Literal(atom=atom, positive=positive):
            return f"{'' if positive else '-'}{text_of(atom)}"
        case syntax.Comparison(left, right, positive):
            return f"{left.name} {'=' if positive else '!='} {right.name}"
        case tuple():
            return ", ".join(map(text_of, part))
        case syntax.SortDefinition(name=name, parts=parts):
            texts = (f"{{{text_of(p)}}}" if isinstance(p, tuple) else p.name for p in parts)
            return f"{name} = {' + '.join(texts)}."
        case syntax.Declaration(kind=kind, name=name, sorts=sorts):
            arguments = f"({text_of(sorts)})" if sorts else ""
            return f"{'' if kind == 'static' else f'{kind} '}{name}{arguments}."
    if type(part) not in _FORMS:
        raise TypeError(f"{type(part).__name__} has no text here")
    values = {n: text_of(v) for n, v in vars(part).items() if n not in ("place", "last_line")}
    body = f" if {values['body']}" if values.get("body") else ""
    return f"{_FORMS[type(part)].format(**values)}{body}."
