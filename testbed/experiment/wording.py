"""Words that tables, reports and the command line share."""

from __future__ import annotations

from collections.abc import Sequence

from testbed.experiment.record import COARSE, Explained
from testbed.protocol import Explanation


def counted(number: int, noun: str) -> str:
    """`1 trial`, `2 trials`: nouns whose plural ends in s."""
    return f"{number} {noun}" if number == 1 else f"{number} {noun}s"


def listed(names: Sequence[str]) -> str:
    """`a`, `a and b`, `a, b and c`."""
    return " and ".join([part for part in (", ".join(names[:-1]), *names[-1:]) if part])


def place(scenario: str, level: str) -> str:
    """What a trial is listed under: its scenario, or at the fine resolution its level."""
    return scenario if level == COARSE else level


def of_place(scenario: str, level: str) -> str:
    """The same with the word for it."""
    return f"scenario {scenario}" if level == COARSE else f"level {level}"


def in_words(name: str) -> str:
    """A name of the record as text: `false_finish` is `false finish`."""
    return name.replace("_", " ")


def chance(p: float | None) -> str:
    """A p-value as text."""
    if p is None:
        return "-"
    return "p < 0.001" if p < 0.001 else f"p = {p:.3f}"


def exception(literal: str) -> str:
    """What holds at step 0 against a default."""
    return f"exception {literal}"


def explanation(told: Explanation | Explained) -> str:
    """An explanation as text: how it began, what others did, what is distrusted."""
    events = [f"{event.action} at step {event.step}" for event in told.unobserved]
    false = [f"distrusted {event.action} at step {event.step}" for event in told.distrusted]
    return ", ".join([*map(exception, told.exceptions), *events, *false]) or "nothing unobserved"
