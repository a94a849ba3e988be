"""What there is to draw of a situation, read off the description's signature alone.

A fluent of a thing and a place says where things are; one of a robot and a thing what it holds; one
of a place alone is a mark of that place, such as a lock. At the fine resolution a fluent of a
component and a cell says where in its place a thing is.
"""

from __future__ import annotations

from collections.abc import Collection, Mapping
from dataclasses import dataclass, field

from asp.language import Description
from asp.language import literals as text
from testbed.environment.core import Core
from testbed.world.layout import Layout, layout, pairs


@dataclass(frozen=True)
class Place:
    """A place, the things lying in it, its robots with what they hold, and its marks.

    `spots` is the cell of each of its things and robots, where it has `cells`.
    """

    name: str
    things: tuple[str, ...]
    robots: dict[str, tuple[str, ...]]
    marks: dict[str, bool]
    next_to: frozenset[str]
    cells: tuple[str, ...] = ()
    spots: Mapping[str, str] = field(default_factory=dict)


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
    where = layout(description)
    robots = dict.fromkeys([*description.robots, core.robot])
    places = tuple(_place(name, description, robots, true, where) for name in where.walk())
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


def _place(
    name: str,
    description: Description,
    robots: Collection[str],
    true: tuple[str, ...],
    where: Layout,
) -> Place:
    found = [pair for pair in pairs(true) if not any(map(where.is_component, pair))]
    here = [thing for thing, place in found if place == name]
    held = {
        robot: tuple(t for one, t in found if one == robot and t not in where.adjacent)
        for robot in robots
    }
    in_hand = {thing for things in held.values() for thing in things}
    marks = [fluent for fluent in description.fluents if text.arguments(fluent) == (name,)]
    cells = where.cells.get(name, ())
    return Place(
        name=name,
        things=tuple(t for t in here if t not in in_hand and t not in held),
        robots={robot: things for robot, things in held.items() if robot in here},
        marks={text.name(mark): mark in true for mark in marks},
        next_to=where.adjacent[name],
        cells=cells,
        spots={where.wholes.get(t, t): cell for t, cell in pairs(true) if cell in cells},
    )


def _shown(arguments: tuple[str, ...], places: tuple[Place, ...]) -> bool:
    """Whether a true fluent of these arguments is among what the places show."""
    names = {name for place in places for name in (place.name, *place.cells)}
    robots = {robot for place in places for robot in place.robots}
    if len(arguments) == 2:
        return arguments[1] in names or arguments[0] in robots
    return len(arguments) == 1 and arguments[0] in names
