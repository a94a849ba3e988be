"""From AL_d text to its abstract syntax, and back."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from functools import cache
from importlib.resources import files
from typing import Any

from lark import Lark, Token, Transformer, v_args
from lark.exceptions import UnexpectedInput
from lark.tree import Meta

from asp.language import syntax
from asp.language.errors import check_section_words, place_of, syntax_error


def parse(text: str, file: str = "<text>") -> syntax.Source:
    """Parses an AL_d text. `file` is the name used in errors. Raises SourceError."""
    return parse_with(grammar("start", "language/al.lark"), ToSyntax(), text, file)


@cache
def grammar(start: str, *texts: str) -> Lark:
    """The parser of the grammar that is in these files of `asp`."""
    rules = "\n".join(files("asp").joinpath(each).read_text(encoding="utf-8") for each in texts)
    return Lark(
        rules, parser="lalr", start=start, propagate_positions=True, maybe_placeholders=True
    )


def parse_with(grammar: Lark, to_syntax: ToSyntax, text: str, file: str) -> syntax.Source:
    """Parses a text in sections. Raises SourceError."""
    try:
        tree = grammar.parse(text)
    except UnexpectedInput as error:
        raise syntax_error(error, text, file, grammar) from None
    check_section_words(tree, text, file)
    return syntax.Source(file, text, to_syntax.transform(tree), _comments(text))


def _comments(text: str) -> tuple[syntax.Comment, ...]:
    lines = (line.partition("%") for line in text.split("\n"))
    return tuple(
        syntax.Comment(number, f"%{comment}".rstrip(), alone=not before.strip())
        for number, (before, sign, comment) in enumerate(lines, start=1)
        if sign
    )


@v_args(meta=True)
class ToSyntax(Transformer[Token, Any]):
    """Builds the abstract syntax bottom-up; the methods are named as the grammar's rules.

    A rule without such a method makes a statement: the rule has the name of its class, whose fields
    are the parts of the rule in their order.
    """

    def __default__(self, data: str, children: list[Any], meta: Meta) -> syntax.Statement:
        name = data.title().replace("_", "")
        kind = next(k for k in syntax.Statement.__subclasses__() if k.__name__ == name)
        parts = (str(part) if isinstance(part, Token) else part for part in children)
        return kind(place_of(meta), meta.end_line, *(() if p is None else p for p in parts))

    def section(self, _: Meta, children: list[Any]) -> list[syntax.Statement]:
        return children[1:]

    sorts = statics = fluents = actions = laws = facts = costs = scenarios = section
    sees_section = shows_section = initially_section = defaults = section

    def start(self, _: Meta, sections: list[list[syntax.Statement]]) -> Any:
        statements = [statement for section in sections for statement in section]
        defaults = {s.name: s for s in statements if isinstance(s, syntax.DefaultStatement)}
        return tuple(
            replace(s, of=defaults.get(s.name)) if isinstance(s, syntax.ExceptionStatement) else s
            for s in statements
        )

    def listed(self, _: Meta, children: list[Any]) -> tuple[Any, ...]:
        return tuple(children)

    sort_parts = members = sort_names = terms = compound = body = drawings = listed

    def range(self, meta: Meta, bounds: list[Token]) -> tuple[syntax.Term, ...]:
        low, high = map(int, bounds)
        last = min(high, low + syntax.MOST_MEMBERS)  # one too many is told where sorts are checked
        return tuple(syntax.Term(str(n), place_of(meta)) for n in range(low, last + 1))

    def static(self, meta: Meta, children: list[Any]) -> syntax.Statement:
        return self.__default__("declaration", ["static", *children], meta)

    def cost_statement(self, meta: Meta, children: list[Any]) -> syntax.Statement:
        action, units = children
        return self.__default__("cost_statement", [action, int(units)], meta)

    def trigger(self, meta: Meta, children: list[Any]) -> syntax.Statement:
        scenario, event, upon, drawings, body, probability = children
        return syntax.TriggerStatement(
            place_of(meta),
            meta.end_line,
            scenario=str(scenario),
            event=event,
            upon=None if isinstance(upon, Token) else upon,
            drawings=drawings or (),
            body=body or (),
            probability=1.0 if probability is None else probability,
        )

    def drawing(self, _: Meta, children: list[Any]) -> syntax.Drawing:
        variable, pool = children
        return syntax.Drawing(variable, pool or ())

    def probability(self, _: Meta, children: list[Token]) -> float:
        return float(children[0])

    def comparison(self, meta: Meta, children: list[Any]) -> syntax.Comparison:
        left, sign, right = children
        return syntax.Comparison(left, right, sign.type == "EQUAL", place_of(meta))

    def literal(self, _: Meta, children: list[Any]) -> syntax.Literal:
        minus, atom = children
        return syntax.Literal(atom, minus is None)

    def atom(self, meta: Meta, children: list[Any]) -> syntax.Atom:
        name, terms = children
        return syntax.Atom(str(name), terms or (), place_of(meta))

    def constant(self, _: Meta, children: list[Token]) -> syntax.Term:
        token = children[0]
        name = str(int(token)) if token.type == "NUMBER" else str(token)
        return syntax.Term(name, place_of(token))

    variable = constant


def scenario_notes(text: str, file: str = "<text>") -> dict[str, str]:
    """The comment right above the first statement of each scenario that has one, as a sentence.

    A scenario's name in front is left out: `% 3: a book leaves.` is `A book leaves.` Raises
    SourceError.
    """
    source = parse(text, file)
    comments = {comment.line: comment.text for comment in source.comments if comment.alone}
    notes: dict[str, str] = {}
    for statement in source.statements:
        if isinstance(statement, syntax.TriggerStatement | syntax.QuietStatement):
            line, above = statement.place.line, list[str]()
            while (line := line - 1) in comments:
                above.insert(0, comments[line].lstrip("% "))
            note = " ".join(above)
            for sign in (",", ":"):
                note = note.removeprefix(f"{statement.scenario}{sign} ")
            notes.setdefault(statement.scenario, note[:1].upper() + note[1:])
    return {scenario: note for scenario, note in notes.items() if note}


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
        case syntax.TriggerStatement():
            return _trigger_text(part)
        case syntax.QuietStatement(scenario=scenario):
            return f"{scenario}: nothing."
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


def _trigger_text(trigger: syntax.TriggerStatement) -> str:
    drawings = (
        f"{text_of(own.variable)}{f' with {text_of(own.pool)}' if own.pool else ''}"
        for own in trigger.drawings
    )
    clauses = (
        ("upon", "any" if trigger.upon is None else text_of(trigger.upon)),
        ("drawing", " then ".join(drawings)),
        ("if", text_of(trigger.body)),
        ("probability", "" if trigger.probability == 1 else str(trigger.probability)),
    )
    said = (f"{word} {clause}" for word, clause in clauses if clause)
    return f"{trigger.scenario}: {text_of(trigger.event)} {' '.join(said)}."
