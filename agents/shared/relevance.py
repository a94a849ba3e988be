"""Which of the fluents that it sees a robot takes into its history (P 3.2)."""

from collections.abc import Iterable

from asp.language import Action, Description, Fluent, Literal


def goal_fluents(description: Description, goal: Iterable[Literal]) -> frozenset[Fluent]:
    """The fluents that bear on the goal.

    These are the fluents of the goal's literals, and those that decide one of them through a
    state constraint: where a book is seen decides that it is nowhere else.
    """
    own = {literal.atom for literal in goal}
    deciding = {
        condition.atom
        for law in description.constraints
        if law.head.atom in own
        for condition in law.body
    }
    return frozenset(own | deciding)


def outcome_literals(
    description: Description, action: Action | None, visible: Iterable[Literal]
) -> tuple[Literal, ...]:
    """What is seen of the outcome of an action: its `shows` statements whose condition is seen."""
    seen = frozenset(visible)
    shown = {
        statement.fluent
        for statement in description.shows
        if statement.action == action and seen.issuperset(statement.body)
    }
    return tuple(literal for literal in visible if literal.atom in shown)


def relevant_literals(
    description: Description,
    goal: frozenset[Literal],
    action: Action | None,
    visible: Iterable[Literal],
) -> tuple[Literal, ...]:
    """The seen literals that bear on the goal (`goal_fluents`) or on the last action."""
    seen = tuple(visible)
    wanted = goal.union(each.atom for each in outcome_literals(description, action, seen))
    return tuple(literal for literal in seen if literal.atom in wanted)
