"""Which of the fluents that it sees a robot takes into its history (P 3.2)."""

from __future__ import annotations

from collections.abc import Iterable

from asp.language import Description, atom


def goal_fluents(description: Description, goal: Iterable[str]) -> frozenset[str]:
    """The fluents that bear on the goal.

    These are the fluents of the goal's literals, and those that decide one of them through a
    state constraint: where a book is seen decides that it is nowhere else.
    """
    own = {atom(literal) for literal in goal}
    deciding = {
        atom(condition)
        for law in description.constraints
        if atom(law.head) in own
        for condition in law.body
    }
    return frozenset(own | deciding)


def outcome_literals(
    description: Description, action: str | None, visible: Iterable[str]
) -> tuple[str, ...]:
    """What is seen of the outcome of an action: its `shows` statements whose condition is seen."""
    seen = frozenset(visible)
    shown = {
        statement.fluent
        for statement in description.shows
        if statement.action == action and seen.issuperset(statement.body)
    }
    return tuple(literal for literal in visible if atom(literal) in shown)


def relevant_literals(
    description: Description, goal: frozenset[str], action: str | None, visible: Iterable[str]
) -> tuple[str, ...]:
    """The seen literals that bear on the goal (`goal_fluents`) or on the last action."""
    seen = tuple(visible)
    wanted = goal.union(map(atom, outcome_literals(description, action, seen)))
    return tuple(literal for literal in seen if atom(literal) in wanted)
