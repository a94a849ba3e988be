"""What is found wrong with a value of a configuration, in words."""

from __future__ import annotations

from collections.abc import Sequence

from asp.language import literals, suggestion
from testbed.config.places import Key

Finding = tuple[Key, str]
"""A key, and one line that says what is wrong with its value."""

NO_ROBOT = (
    "has no robot: nobody sees anything in it; "
    "in its section 'sees' write for example: R sees f(X) if robot(R)."
)
"""What is wrong with a domain without `sees`: the robot is the one that sees."""


def unknown_atom(text: str, known: Sequence[str], what: str) -> str:
    """Say what is wrong with a ground atom that is not among the known ones, and what is right."""
    name, values = literals.name(text), literals.arguments(text)
    same = [literals.arguments(item) for item in known if literals.name(item) == name]
    if not same:
        return f"no {what} '{name}'; {suggestion(name, map(literals.name, known))}"
    if len(values) != len(same[0]):
        return f"{name} takes {len(same[0])} arguments, as in {literals.ground(name, same[0])}"
    for position, value in enumerate(values):
        possible = {parts[position] for parts in same}
        if value not in possible:
            return f"'{value}' in {text} is not known there; {suggestion(value, possible)}"
    return f"{text} is not a {what}; {suggestion(text, known)}"
