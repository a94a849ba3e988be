"""What a robot knows of its domain: the description, its program, the order of its actions."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from functools import cache

from clingo import Symbol

from asp.description import Description
from asp.literals import atom, is_positive
from asp.loading import parse_description
from asp.solving import fact
from asp.translation import translate


@dataclass(frozen=True)
class Knowledge:
    """A domain as a robot uses it."""

    description: Description
    program: str
    ranks: tuple[Symbol, ...]


@cache
def knowledge(name: str, source: str) -> Knowledge:
    """The knowledge that an AL_d text holds. Raises asp.SourceError."""
    description = parse_description(source, f"{name}.al")
    return Knowledge(description, translate(source, name), tuple(_ranks(description)))


def goal_facts(goal: Iterable[str]) -> Iterator[Symbol]:
    """goal(F,B) for each literal of the goal."""
    for literal in goal:
        yield fact("goal", atom(literal), "true" if is_positive(literal) else "false")


def _ranks(description: Description) -> Iterator[Symbol]:
    """rank(A,R): the place of each action in the order of declaration, from 0."""
    kinds = (description.agent_actions, description.exogenous_actions)
    yield fact("ranks", max(map(len, kinds)))
    for actions in kinds:
        for number, action in enumerate(actions):
            yield fact("rank", action, number)
