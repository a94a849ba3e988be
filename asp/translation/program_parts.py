"""The rules of a compact program, in the parts that they are grounded with."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

from asp.translation.rules import rule

BASE, OPEN, STATE, STEP = "base", "open", "state(t)", "step(t)"
BEFORE, NOW = "t-1", "t"
ACTION = "action"  # as a function: the action that occurs at a step


@dataclass(frozen=True)
class Rule:
    """A rule of a part of the program, with the constants that it names.

    `gives` is the function that the head gives a value and the fluent that says so, where there is
    one: (`fine_loc(P)`, `fine_loc(P,C)`). What is chosen at step 0 has it for every fluent. What
    enables an action has it for the action, as a value of ACTION.
    """

    part: str
    head: str
    body: tuple[str, ...]
    constants: frozenset[str] = frozenset()
    gives: tuple[str, str] | None = None


def plain(law: Rule) -> Iterator[str]:
    """The text of a rule."""
    yield rule(law.head, law.body)


def confined(law: Rule) -> Iterator[str]:
    """The texts of a rule where functions may be confined at some steps to some values.

    What would give a fluent's function another value then is a constraint; another action is not
    enabled. What is chosen at step 0 is given instead. See `problem` in
    `incremental_fine_planning`.
    """
    if law.gives is None:
        if law.part != OPEN:
            yield from plain(law)
        return
    function, value = law.gives
    if law.part == OPEN:
        yield rule("", [f"holds({value},0)", f"not given({value})"])
        return
    step = BEFORE if function == ACTION else NOW
    yield rule(law.head, [*law.body, f"not confined({function},{step})"])
    yield rule(law.head, [*law.body, f"within({value},{step})"])
    if function != ACTION:
        confines = f"confined({function},{step})"
        yield rule("", [*law.body, confines, f"not within({value},{step})"])
