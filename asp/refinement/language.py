"""The text of a refinement: what the designer adds to a coarse description, and its parser."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cache
from importlib.resources import files
from typing import ClassVar

from lark import Lark, Token, v_args
from lark.exceptions import UnexpectedInput
from lark.tree import Meta

from asp.language import (
    ToSyntax,
    Words,
    check_section_words,
    comments_of,
    place_of,
    syntax,
    syntax_error,
)
from asp.language import variable_sorts as roles

_WORDS = Words(
    frozenset({"REFINES", "MAGNIFY", "COMPONENTS", "COUNTERPARTS", "FACTS", "LAWS", "TESTS"}),
    "magnify or components",
)


@dataclass(frozen=True)
class Refines(syntax.Statement):
    """`refines name.` or `refines "path".`: the coarse description."""

    name: str


@dataclass(frozen=True)
class Magnification(syntax.Statement):
    """`sort into fine.`: the constants of a coarse sort have components, those of a fine one."""

    sort: syntax.Term
    into: str


@dataclass(frozen=True)
class Components(syntax.Statement):
    """`whole = {part, part}.`"""

    whole: syntax.Term
    parts: tuple[syntax.Term, ...]


@dataclass(frozen=True)
class Counterpart(syntax.Statement):
    """An attribute or action that gets a fine counterpart."""

    symbol: syntax.Term


@dataclass(frozen=True)
class TestsStatement(syntax.Statement):
    """`robot tests fluent if body`: in which states the robot can test whether the fluent holds."""

    robot: syntax.Term
    fluent: syntax.Atom
    body: syntax.Body


roles.ROLES[TestsStatement] = {"fluent": (roles.FLUENTS, "a fluent after 'tests'")}


def parse_fine(text: str, file: str = "<text>") -> syntax.Source:
    """The statements of a refinement's text. Raises SourceError."""
    try:
        tree = _grammar().parse(text)
    except UnexpectedInput as error:
        raise syntax_error(error, text, file, _WORDS) from None
    check_section_words(tree, text, file)
    return syntax.Source(file, text, _ToRefinement().transform(tree), comments_of(text))


@cache
def _grammar() -> Lark:
    texts = (
        files("asp").joinpath("language", "al.lark"),
        files("asp").joinpath("refinement", "fine.lark"),
    )
    grammar = "\n".join(entry.read_text(encoding="utf-8") for entry in texts)
    return Lark(
        grammar,
        parser="lalr",
        start="refinement",
        propagate_positions=True,
        maybe_placeholders=True,
    )


@v_args(meta=True)
class _ToRefinement(ToSyntax):
    """Builds the abstract syntax bottom-up; the ."""

    STATEMENTS: ClassVar = {
        "magnification": Magnification,
        "components": Components,
        "counterpart": Counterpart,
        "test": TestsStatement,
        **ToSyntax.STATEMENTS,
    }

    magnify = components_section = counterparts = tests_section = ToSyntax.section
    refinement = ToSyntax.start

    def refines(self, meta: Meta, children: list[Token]) -> list[Refines]:
        return [Refines(place_of(meta), meta.end_line, str(children[1]).strip('"'))]
