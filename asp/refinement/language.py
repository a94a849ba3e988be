"""The text of a refinement: what the designer adds to a coarse description, and its parser."""

from lark import Token, v_args
from lark.tree import Meta

from asp.language import ToSyntax, grammar, parse_with, syntax
from asp.language import variable_sorts as roles


class Refines(syntax.Statement):
    """`refines name.` or `refines "path".`: the coarse description."""

    name: str


class Magnification(syntax.Statement):
    """`sort into fine.`: the constants of a coarse sort have components, those of a fine one."""

    sort: syntax.Term
    into: str


class Components(syntax.Statement):
    """`whole = {part, part}.`"""

    whole: syntax.Term
    parts: tuple[syntax.Term, ...]


class Counterpart(syntax.Statement):
    """An attribute or action that gets a fine counterpart."""

    symbol: syntax.Term


class TestsStatement(syntax.Statement):
    """`robot tests fluent if body`: in which states the robot can test whether the fluent holds."""

    robot: syntax.Term
    fluent: syntax.Atom
    body: syntax.Body


roles.ROLES[TestsStatement] = {"fluent": (roles.FLUENTS, "a fluent after 'tests'")}


def parse_fine(text: str, file: str = "<text>") -> syntax.Source:
    """The statements of a refinement's text. Raises SourceError."""
    texts = "language/al.lark", "refinement/fine.lark"
    return parse_with(grammar("refinement", *texts), _ToRefinement(), text, file)


@v_args(meta=True)
class _ToRefinement(ToSyntax):
    """Builds the abstract syntax of a refinement bottom-up."""

    magnify = components_section = counterparts = tests_section = ToSyntax.section
    refinement = ToSyntax.start

    def refines(self, meta: Meta, children: list[Token]) -> list[syntax.Statement]:
        return [self.__default__("refines", [children[1].strip('"')], meta)]
