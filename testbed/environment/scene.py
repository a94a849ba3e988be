"""What there is to draw of a situation, read off the description's signature alone.

A place is a member of the sort over which a two-place static (an adjacency) ranges; a fluent of a
thing and a place says where things are; one of a robot and a thing what it holds; one of a place
alone is a mark of that place, such as a lock.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from typing import TypeAlias

from asp import literals as text
from asp.description import Description
from testbed.environment.core import Core

Adjacency: TypeAlias = dict[str, frozenset[str]]


@dataclass(frozen=True)
class Place:
    """A place, the things lying in it, its robots with what they hold, and its marks."""

    name: str
    things: tuple[str, ...]
    robots: dict[str, tuple[str, ...]]
    marks: dict[str, bool]
    next_to: frozenset[str]


@dataclass(frozen=True)
class Scene:
    """The places in the order of a walk, what just happened, and what the places do not show.

    `robot` and `adversary` are what the two did at the step before, "" at the first one; `rest`
    are the true fluents that have no place in the picture.
    """

    step: int
    places: tuple[Place, ...]
    rest: tuple[str, ...]
    robot: str
    adversary: str
    outcome: str


def scene(core: Core) -> Scene:
    """The scene of the core's present situation."""
    now, description = core.situation, core.world.description
    true = core.world.true_atoms(now.state)
    adjacent = _adjacency(description)
    places = tuple(_place(name, description, true, adjacent) for name in _walk(adjacent))
    return Scene(
        step=now.step,
        places=places,
        rest=tuple(fluent for fluent in true if not _shown(text.arguments(fluent), places)),
        robot=_said(now.answer, now.happened),
        adversary=now.event or "",
        outcome=now.ending or "",
    )


def _said(answer: str | None, happened: bool | None) -> str:
    return f"{answer} failed" if happened is False else answer or ""


def _adjacency(description: Description) -> Adjacency:
    """The neighbours of each place, in the order in which the places are declared."""
    pairs = _pairs(description.statics)
    joined = {constant for pair in pairs for constant in pair}
    sorts = [members for members in description.sorts.values() if joined <= set(members)]
    places = min(sorts, key=len) if joined and sorts else ()
    return {
        place: frozenset({b for a, b in pairs if a == place} | {a for a, b in pairs if b == place})
        for place in places
    }


def _walk(adjacent: Adjacency) -> tuple[str, ...]:
    """The places in depth-first order, from a dead end if there is one."""
    seen: dict[str, None] = {}
    stack = sorted(adjacent, key=lambda place: len(adjacent[place]) != 1)[::-1]
    while stack:
        place = stack.pop()
        if place not in seen:
            seen[place] = None
            stack += [other for other in reversed(list(adjacent)) if other in adjacent[place]]
    return tuple(seen)


def _place(
    name: str, description: Description, true: tuple[str, ...], adjacent: Adjacency
) -> Place:
    pairs = _pairs(true)
    here = [thing for thing, place in pairs if place == name]
    held = {
        robot: tuple(thing for one, thing in pairs if one == robot and thing not in adjacent)
        for robot in description.robots
    }
    in_hand = {thing for things in held.values() for thing in things}
    marks = [fluent for fluent in description.fluents if text.arguments(fluent) == (name,)]
    return Place(
        name=name,
        things=tuple(t for t in here if t not in in_hand and t not in held),
        robots={robot: things for robot, things in held.items() if robot in here},
        marks={text.name(mark): mark in true for mark in marks},
        next_to=adjacent[name],
    )


def _shown(arguments: tuple[str, ...], places: tuple[Place, ...]) -> bool:
    """Whether a true fluent of these arguments is among what the places show."""
    names = {place.name for place in places}
    robots = {robot for place in places for robot in place.robots}
    if len(arguments) == 2:
        return arguments[1] in names or arguments[0] in robots
    return len(arguments) == 1 and arguments[0] in names


def _pairs(atoms: Iterable[str]) -> list[tuple[str, str]]:
    """The arguments of the two-place atoms."""
    found = (text.arguments(atom) for atom in atoms)
    return [(args[0], args[1]) for args in found if len(args) == 2]
