"""The rooms of the office, and its fluents, literals and actions as users see them: texts."""

from collections.abc import Collection

ROBOT, SECURE = "rob1", "library"
ROOMS = ("kitchen", "office1", "office2", SECURE)
DOORS = frozenset({("office1", "office2"), ("office2", "kitchen"), ("kitchen", SECURE)})
Literals = Collection[str]
Plan = tuple[str, ...]


def parts(action: str) -> tuple[str, list[str]]:
    """The name of a fluent or an action, and its arguments."""
    name, _, inside = action.rstrip(")").partition("(")
    return name, inside.split(",")


def atom(literal: str) -> str:
    """The literal without its sign."""
    return literal.removeprefix("-")


def complement(literal: str) -> str:
    """The same atom with the other sign."""
    return atom(literal) if literal.startswith("-") else f"-{literal}"


def next_to(one: str, other: str) -> bool:
    """Whether a door connects two rooms."""
    return (one, other) in DOORS or (other, one) in DOORS
