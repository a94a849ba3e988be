"""Variables with a few values each: literals and laws about them, where some values are known."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

Literal = tuple[int, int, bool]
"""A variable, a value, and whether the variable has it."""

Body = tuple[Literal, ...]

UNDECIDED = -1
"""Stands for the value of a variable of which nothing is known."""


@dataclass(frozen=True)
class Law:
    """`head if body`."""

    head: Literal
    body: Body


def by_value(bodies: Sequence[Body], variable: int, size: int) -> list[list[Body]]:
    """Of each value of a variable, what is then left of the bodies that it does not make false."""
    found: list[list[Body]] = [[] for _ in range(size)]
    for body in bodies:
        rest = tuple(literal for literal in body if literal[0] != variable)
        values = set(range(size)) if len(rest) == len(body) else _values(body, variable, size)
        for value in values:
            found[value].append(rest)
    return found


def _values(body: Body, variable: int, size: int) -> set[int]:
    """The values of a variable that satisfy what a body says of it."""
    values = set(range(size))
    for about, value, truth in body:
        if about == variable:
            values &= {value} if truth else values - {value}
    return values


def pairs(before: Sequence[int]) -> tuple[tuple[int, int], ...]:
    """The variables that have a value, each with it."""
    return tuple((v, x) for v, x in enumerate(before) if x != UNDECIDED)


def truth_of(literal: Literal, state: Sequence[int]) -> bool | None:
    """Whether a literal is true; None where its variable is undecided."""
    variable, value, truth = literal
    known = state[variable]
    return None if known == UNDECIDED else (known == value) == truth


def unknown_in(body: Body, state: Sequence[int]) -> int | None:
    """None if the body is true; -1 if it is false; else a variable that decides it."""
    first: int | None = None
    for literal in body:
        truth = truth_of(literal, state)
        if truth is False:
            return -1
        if truth is None and first is None:
            first = literal[0]
    return first


def says(known: Literal, condition: Literal) -> bool:
    """Whether one literal makes the other true: also, that a variable has another value."""
    if known[:2] == condition[:2]:
        return known[2] == condition[2]
    return known[0] == condition[0] and known[2] and not condition[2]
