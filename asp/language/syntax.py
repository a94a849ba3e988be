"""The abstract syntax of AL_d: the result of parsing a text, before any sort is known."""

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Literal as Choice
from typing import TypeVar, dataclass_transform

S = TypeVar("S", bound="Statement")

MOST_MEMBERS = 100_000
"""Of a sort."""

SymbolKind = Choice["static", "inertial", "defined", "agent", "exogenous"]


@dataclass_transform(frozen_default=True)
class Node:
    """A part of a description, of its text or ground; each kind of them is a frozen dataclass."""

    def __init_subclass__(cls) -> None:
        dataclass(frozen=True)(cls)


class Place(Node):
    """Line and column, both counted from 1."""

    line: int
    column: int


class Term(Node):
    """A constant or a variable."""

    name: str
    place: Place

    @property
    def is_variable(self) -> bool:
        return self.name[0].isupper()


class Atom(Node):
    """A name with arguments; `str()` gives it as ASP has it, without blanks."""

    name: str
    args: tuple[Term, ...]
    place: Place

    def __str__(self) -> str:
        return f"{self.name}({','.join(t.name for t in self.args)})" if self.args else self.name


class Literal(Node):
    atom: Atom
    positive: bool

    @property
    def terms(self) -> tuple[Term, ...]:
        return self.atom.args


class Comparison(Node):
    """`left = right` or, when not `positive`, `left != right`."""

    left: Term
    right: Term
    positive: bool
    place: Place

    @property
    def terms(self) -> tuple[Term, ...]:
        return self.left, self.right


Condition = Literal | Comparison
Body = tuple[Condition, ...]


class Statement(Node):
    """Anything that ends with a full stop; `last_line` is the line of that full stop."""

    place: Place
    last_line: int


class SortDefinition(Statement):
    """`name = part + part.` A part is the name of a sort or a tuple of constants."""

    name: str
    parts: tuple[Term | tuple[Term, ...], ...]


class Declaration(Statement):
    """A static, fluent or action with the sorts of its arguments."""

    kind: SymbolKind
    name: str
    sorts: tuple[Term, ...]


class CausalLaw(Statement):
    action: Atom
    head: Literal
    body: Body


class StateConstraint(Statement):
    head: Literal
    body: Body


class ExecutabilityCondition(Statement):
    actions: tuple[Atom, ...]
    body: Body


class Fact(Statement):
    literal: Literal


class SeesStatement(Statement):
    """`robot sees fluent if body`: in which states the robot sees whether the fluent holds."""

    robot: Term
    fluent: Atom
    body: Body


class ShowsStatement(Statement):
    """`action shows fluent if body`: what the outcome of an action lets its agent see."""

    action: Atom
    fluent: Atom
    body: Body


class CostStatement(Statement):
    """`action costs n`, in execution units."""

    action: Atom
    units: int


class InitiallyStatement(Statement):
    """`fluent for some V`: in an initial state the fluent is true for at least one V."""

    fluent: Atom
    variable: Term


class DefaultStatement(Statement):
    """`name: head if body`: in an initial state the head usually holds where the body does."""

    name: str
    head: Literal
    body: Body


class ExceptionStatement(Statement):
    """`exception name if body`: where the body holds, the default says nothing.

    The variables are those of the default, which is `of`; None where there is none of that name.
    """

    name: str
    body: Body
    of: DefaultStatement | None = None


class Drawing(Node):
    """`variable with pool`: a value of the variable is drawn, of those for which the pool holds."""

    variable: Term
    pool: Body


class TriggerStatement(Statement):
    """`scenario: event upon action drawing V with pool then ... if body probability p`."""

    scenario: str
    event: Atom
    upon: Atom | None
    drawings: tuple[Drawing, ...]
    body: Body
    probability: float


class QuietStatement(Statement):
    """`scenario: nothing`: a scenario in which nothing exogenous happens."""

    scenario: str


class Comment(Node):
    line: int
    text: str
    alone: bool


class Source(Node):
    """A parsed AL_d text: its statements and comments in the order of the file."""

    file: str
    text: str
    statements: tuple[Statement, ...]
    comments: tuple[Comment, ...]

    def each(self, kind: type[S]) -> Iterator[S]:
        """The statements of one kind, in order."""
        return (s for s in self.statements if isinstance(s, kind))

    @property
    def scenarios(self) -> tuple[str, ...]:
        """The names of the scenarios, also of those in which nothing happens, in order."""
        own = (s for s in self.statements if isinstance(s, TriggerStatement | QuietStatement))
        return tuple(dict.fromkeys(statement.scenario for statement in own))
