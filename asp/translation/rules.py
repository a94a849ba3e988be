"""Pieces of ASP text made of abstract syntax, and the rules of compact programs in their parts."""

from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from enum import StrEnum

from asp.language import Literal, Signature, syntax, text_of
from asp.language import variable_sorts as roles


def rule(head: object, body: Iterable[str]) -> str:
    """`head :- body.`, a fact if the body is empty, a constraint if the head is."""
    conditions = ", ".join(body)
    if not conditions:
        return f"{head}."
    return f"{head} :- {conditions}." if head else f":- {conditions}."


def condition(
    part: syntax.Condition, signature: Signature, step: str = "I", denied: str = "-"
) -> str:
    """A condition of a body, or a head: fluents in `holds`, statics and sorts as they stand.

    `denied` stands before what has to be false: `-`, or `not `.
    """
    if isinstance(part, syntax.Comparison):
        return text_of(part)
    sign = "" if part.positive else denied
    name = part.atom.name
    if signature.kind(name) in (roles.SORT, "static"):
        return f"{sign}{part.atom}"
    return f"{sign}holds({part.atom},{step})"


def sorts_of_variables(
    statement: syntax.Statement, signature: Signature
) -> Iterable[tuple[str, str]]:
    """The variables of a statement with the sorts of all their places, each pair once."""
    return dict.fromkeys(
        (term.name, sort)
        for use in roles.scope(statement)
        if use.atom.name not in signature.sorts
        for term, sort in zip(use.atom.args, signature.sorts_of(use.atom.name), strict=True)
        if term.is_variable
    )


def sort_conditions(statement: syntax.Statement, signature: Signature) -> list[str]:
    """`sort(V)` for the variables of a statement, by all the places where they stand, each once."""
    return [f"{sort}({name})" for name, sort in sorts_of_variables(statement, signature)]


def schema(symbol: syntax.Declaration) -> tuple[Literal, list[str], list[str]]:
    """A symbol with variables for its arguments: `loc(X1,X2)`, X1 and X2, `room(X1)` and so on."""
    variables = [f"X{number}" for number, _ in enumerate(symbol.sorts, start=1)]
    sorts = [f"{sort.name}({v})" for sort, v in zip(symbol.sorts, variables, strict=True)]
    return Literal.of(symbol.name, variables), variables, sorts


class Part(StrEnum):
    """The parts of a compact program; in OPEN the state at step 0 is chosen."""

    BASE = "base"
    OPEN = "open"
    STATE = "state(t)"
    STEP = "step(t)"


BEFORE, NOW = "t-1", "t"
ACTION = Literal.of("action")  # as a function: the action that occurs at a step


@dataclass(frozen=True)
class Rule:
    """A rule of a part of the program, with the constants that it names.

    `gives` is the function that the head gives a value and the fluent that says so, where there is
    one: (`fine_loc(P)`, `fine_loc(P,C)`). What is chosen at step 0 has it for every fluent. What
    enables an action has it for the action, as a value of ACTION. `loose` are the sorts of
    variables that stand in neither the head nor a condition of the body that has to be true.
    """

    part: Part
    head: str
    body: tuple[str, ...]
    constants: frozenset[str] = frozenset()
    gives: tuple[str, str] | None = None
    loose: frozenset[str] = frozenset()

    def plain(self) -> Iterator[str]:
        """The text of the rule."""
        yield rule(self.head, self.body)

    def confined(self) -> Iterator[str]:
        """The texts of the rule where functions may be confined at some steps to some values.

        What would give a fluent's function another value then is a constraint; another action is
        not enabled. What is chosen at step 0 is given instead. See the part `problem` of
        `incremental_fine_planning.lp`.
        """
        if self.gives is None:
            if self.part != Part.OPEN:
                yield from self.plain()
            return
        function, value = self.gives
        if self.part == Part.OPEN:
            yield rule("", [f"holds({value},0)", f"not given({value})"])
            return
        step = BEFORE if function == ACTION else NOW
        confines, within = f"confined({function},{step})", f"within({value},{step})"
        yield rule(self.head, [*self.body, f"not {confines}"])
        yield rule(self.head, [*self.body, within])
        if function != ACTION:
            yield rule("", [*self.body, confines, f"not {within}"])
