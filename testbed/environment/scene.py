"""What there is to draw of a situation, read off the description's signature alone.

A place is a member of the sort over which a two-place static (an adjacency) ranges; a fluent of a
thing and a place says where things are; one of a robot and a thing what it holds; one of a place
alone is a mark of that place, such as a lock.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

from asp import literals as text
from asp.description import Description
from testbed.environment.core import Core


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
    """The places in the order of a walk, what is in none of them, and what just happened."""

    step: int
    places: tuple[Place, ...]
    nowhere: tuple[str, ...]
    robot: str
    adversary: str
    outcome: str


def scene(core: Core) -> Scene:
    """The scene of the core's present situation."""
    now, description = core.situation, core.world.description
    true = core.world.true_atoms(now.state)
    adjacent = _adjacency(description)
    places = tuple(_place(place, description, true, adjacent[place]) for place in _walk(adjacent))
    return Scene(
        step=now.step,
        places=places,
        nowhere=_nowhere(description, true, adjacent),
        robot=_said(now.answer, now.happened),
        adversary=now.event or "",
        outcome=now.ending or "",
    )


def _said(answer: str | None, happened: bool | None) -> str:
    return f"{answer} failed" if happened is False else answer or ""


def _adjacency(description: Description) -> dict[str, frozenset[str]]:
    """The neighbours of each place, in the order in which the places are declared."""
    pairs = [args for args in map(text.arguments, description.statics) if len(args) == 2]
    joined = {constant for pair in pairs for constant in pair}
    sorts = [members for members in description.sorts.values() if joined <= set(members)]
    places = min(sorts, key=len) if joined and sorts else ()
    return {
        place: frozenset({b for a, b in pairs if a == place} | {a for a, b in pairs if b == place})
        for place in places
    }


def _walk(adjacent: dict[str, frozenset[str]]) -> tuple[str, ...]:
    """The places in depth-first order, from a dead end if there is one."""
    seen: list[str] = []
    ends = sorted(adjacent, key=lambda place: len(adjacent[place]) != 1)
    stack = ends[::-1]
    while stack:
        place = stack.pop()
        if place not in seen:
            seen.append(place)
            stack += [p for p in reversed(list(adjacent)) if p in adjacent[place] - set(seen)]
    return tuple(seen)


def _place(
    place: str, description: Description, true: tuple[str, ...], next_to: frozenset[str]
) -> Place:
    here = [args[0] for args in map(text.arguments, true) if len(args) == 2 and args[1] == place]
    robots = {robot: _held(robot, true, description) for robot in description.robots}
    in_hand = {thing for held in robots.values() for thing in held}
    return Place(
        name=place,
        things=tuple(t for t in here if t not in in_hand and t not in robots),
        robots={robot: held for robot, held in robots.items() if robot in here},
        marks=dict(_marks(place, description, true)),
        next_to=next_to,
    )


def _held(robot: str, true: tuple[str, ...], description: Description) -> tuple[str, ...]:
    pairs = [args for args in map(text.arguments, true) if len(args) == 2 and args[0] == robot]
    return tuple(thing for _, thing in pairs if thing not in _adjacency(description))


def _marks(
    place: str, description: Description, true: tuple[str, ...]
) -> Iterator[tuple[str, bool]]:
    for fluent in description.fluents:
        if text.arguments(fluent) == (place,):
            yield text.name(fluent), fluent in true


def _nowhere(
    description: Description, true: tuple[str, ...], places: dict[str, frozenset[str]]
) -> tuple[str, ...]:
    """The things that a fluent could place, and no true one does."""
    located = [args for f in description.fluents if len(args := text.arguments(f)) == 2]
    movable = dict.fromkeys(thing for thing, place in located if place in places)
    placed = {args[0] for a in true if len(args := text.arguments(a)) == 2 and args[1] in places}
    return tuple(thing for thing in movable if thing not in placed)
