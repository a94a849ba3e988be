"""The rules of a compact program, in the parts that they are grounded with."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

from asp.rules import rule

BASE, OPEN, STATE, STEP = "base", "open", "state(t)", "step(t)"
BEFORE, NOW = "t-1", "t"


@dataclass(frozen=True)
class Rule:
    """A rule of a part of the program, with the constants that it names.

    `gives` is the function that the head gives a value and the fluent that says so, where there is
    one: (`fine_loc(P)`, `fine_loc(P,C)`). What is chosen at step 0 has it for every fluent.
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

    What would give one another value then is a constraint (`kept_fitted`). What is chosen at step 0
    is given instead.
    """
    if law.gives is None:
        if law.part != OPEN:
            yield from plain(law)
        return
    function, fluent = law.gives
    if law.part == OPEN:
        yield rule("", [f"holds({fluent},0)", f"not given({fluent})"])
        return
    confines = f"confined({function},{NOW})"
    yield rule(law.head, [*law.body, f"not {confines}"])
    yield rule(law.head, [*law.body, f"within({fluent},{NOW})"])
    yield rule("", [*law.body, confines, f"not within({fluent},{NOW})"])
