"""Variables of a description: sets of fluents whose values a heuristic looks at.

A variable is a mask of fluents; its value in a state is the mask of those that are true.
"""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterable
from math import prod

from asp.language import Description, arguments, atom, is_positive


def variables(description: Description) -> tuple[int, ...]:
    """For each constant the fluents that mention it; each fluent without constants by itself.

    A variable that could have more values than two functions of its fluents is left out.
    """
    about: dict[str, list[int]] = defaultdict(list)
    for number, fluent in enumerate(description.fluents):
        for constant in dict.fromkeys(arguments(fluent)) or (fluent,):
            about[constant].append(number)
    exclusive = _exclusive(description)
    return tuple(
        sum(1 << number for number in fluents)
        for fluents in about.values()
        if _most_values(fluents, exclusive) <= max(2, len(fluents) ** 2)
    )


def _exclusive(description: Description) -> frozenset[tuple[int, int]]:
    """Pairs of fluents of which a constraint allows at most one."""
    number: dict[str, int] = {fluent: i for i, fluent in enumerate(description.fluents)}
    pairs = [
        (number[law.body[0]], number[atom(law.head)])
        for law in description.constraints
        if len(law.body) == 1 and is_positive(law.body[0]) and not is_positive(law.head)
    ]
    return frozenset((*pairs, *(pair[::-1] for pair in pairs)))


def _most_values(fluents: Iterable[int], exclusive: frozenset[tuple[int, int]]) -> int:
    """How many values at most: of fluents that exclude each other one is true, or none."""
    groups: list[list[int]] = []
    for fluent in fluents:
        fitting = (g for g in groups if exclusive.issuperset((fluent, other) for other in g))
        group = next(fitting, None)
        if group is None:
            groups.append([fluent])
        else:
            group.append(fluent)
    return prod(len(group) + 1 for group in groups)
