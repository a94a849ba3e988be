"""The scene to draw of a situation, read off the description alone.

A fluent of a thing and a place says where things are, unless by the laws another fluent gives the
thing one place at a time; one of a robot and a thing says what it holds; one of a place alone is a
mark of that place. At the fine resolution a fluent of a component and a cell says
where in its place a thing is.

A place is a member of the sort over which a two-place static (an adjacency) ranges. Where another
static gives each member of one such sort a member of another, the former are cells of the latter,
and what else that static relates are components and their wholes. Else the places are those of the
adjacency that says most.
"""

from collections.abc import Collection, Iterable, Mapping
from dataclasses import dataclass, field, replace
from itertools import permutations
from typing import TypeAlias

from asp.language import Description, Fluent, Literal
from testbed.environment.rules import Situation
from testbed.world import World

Pair: TypeAlias = tuple[str, str]


@dataclass(frozen=True)
class Layout:
    """Places with their neighbours, in the order of declaration.

    At the fine resolution `cells` are those of each place, and `wholes` what each constant is a
    component of.
    """

    adjacent: Mapping[str, frozenset[str]]
    cells: Mapping[str, tuple[str, ...]] = field(default_factory=dict)
    wholes: Mapping[str, str] = field(default_factory=dict)

    def walk(self) -> tuple[str, ...]:
        """The places in depth-first order, from a dead end if there is one."""
        seen: dict[str, None] = {}
        stack = sorted(self.adjacent, key=lambda place: len(self.adjacent[place]) != 1)[::-1]
        while stack:
            place = stack.pop()
            if place not in seen:
                seen[place] = None
                neighbours = self.adjacent[place]
                stack += [other for other in reversed(list(self.adjacent)) if other in neighbours]
        return tuple(seen)


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
    rest: tuple[Fluent, ...]
    robot: str
    adversary: str
    outcome: str


def scene(world: World, now: Situation, robot: str) -> Scene:
    """The scene of a robot's situation in a world."""
    answer = now.answer or ""
    return replace(
        Stage(world.description, robot).still(world.true_atoms(now.state)),
        step=now.step,
        robot=f"{answer} failed" if now.happened is False else answer,
        adversary=now.event or "",
        outcome=now.ending or "",
    )


class Stage:
    """The places of a domain, and scenes there of which only the true fluents are known."""

    def __init__(self, description: Description, robot: str = "") -> None:
        """`robot` is one even where it does nothing."""
        self._where = layout(description)
        actors = {action.arguments[0] for action in description.agent_actions if action.arguments}
        self._walk = self._where.walk()
        self._cells = {cell for cells in self._where.cells.values() for cell in cells}
        acting = [own for own in description.robots if own in actors]  # a thing may see as well
        self._robots = dict.fromkeys([*acting, *([robot] if robot else [])])
        self._order = {fluent: number for number, fluent in enumerate(description.fluents)}
        self._marks: dict[str, list[Fluent]] = {}
        for fluent in description.fluents:
            if len(fluent.arguments) == 1:
                self._marks.setdefault(fluent.arguments[0], []).append(fluent)
        self._locating = _locating(description, self._where.adjacent)

    def still(self, true: Iterable[Fluent]) -> Scene:
        """The scene in which just these fluents are true; nothing happened before it.

        Whatever their order, it is that of declaration in the scene.
        """
        atoms = tuple(sorted(true, key=lambda fluent: (self._order.get(fluent, -1), fluent)))
        related, where = pairs(filter(self._is_spatial, atoms)), self._where
        # What is said of components only says in which cell their wholes are.
        found = [pair for pair in related if all(where.wholes.get(c, c) == c for c in pair)]
        present = {robot for robot, place in found if place in where.adjacent} & {*self._robots}
        held = {
            robot: tuple(t for one, t in found if one == robot and t not in where.adjacent)
            for robot in self._robots
            if robot in present
        }
        spots = {where.wholes.get(t, t): cell for t, cell in related if cell in self._cells}
        places = tuple(self._place(name, {*atoms}, found, held, spots) for name in self._walk)
        located = {*where.adjacent, *self._cells}

        def is_shown(fluent: Fluent) -> bool:
            arguments = fluent.arguments
            if len(arguments) == 2 and self._is_spatial(fluent):
                return arguments[1] in located or arguments[0] in present
            return len(arguments) == 1 and arguments[0] in where.adjacent

        rest = tuple(fluent for fluent in atoms if not is_shown(fluent))
        return Scene(step=0, places=places, rest=rest, robot="", adversary="", outcome="")

    def _is_spatial(self, fluent: Fluent) -> bool:
        """Whether it does not only say something about a place of a thing that is elsewhere."""
        thing, *others = fluent.arguments or ("",)
        own = self._locating.get(thing)
        return own is None or fluent.name in own or not self._where.adjacent.keys() & {*others}

    def _place(
        self,
        name: str,
        true: Collection[Fluent],
        found: list[Pair],
        held: Mapping[str, tuple[str, ...]],
        spots: Mapping[str, str],
    ) -> Place:
        here = dict.fromkeys(thing for thing, place in found if place == name)
        in_hand = {thing for things in held.values() for thing in things}
        cells = self._where.cells.get(name, ())
        return Place(
            name=name,
            things=tuple(t for t in here if t not in in_hand and t not in held),
            robots={robot: things for robot, things in held.items() if robot in here},
            marks={mark.name: mark in true for mark in self._marks.get(name, ())},
            next_to=self._where.adjacent[name],
            cells=cells,
            spots={thing: cell for thing, cell in spots.items() if cell in cells},
        )


def _locating(description: Description, places: Collection[str]) -> dict[str, set[str]]:
    """The fluents that give a thing one place at a time, for each thing that has such ones."""
    found: dict[str, set[str]] = {}
    for law in description.constraints:
        name, arguments = law.head.name, law.head.arguments
        if law.head.is_positive or len(arguments) != 2 or arguments[1] not in places:
            continue
        elsewhere = (own.arguments for own in law.body if own.name == name and own.is_positive)
        if any(thing == arguments[0] and place in places for thing, place in elsewhere):
            found.setdefault(arguments[0], set()).add(name)
    return found


def layout(description: Description) -> Layout:
    """The layout of a domain; no places at all where nothing is adjacent."""
    named: dict[str, list[Pair]] = {}
    for static in sorted(description.statics):
        named.setdefault(static.name, []).extend(pairs([static]))
    spaces = {name: _places(found, description) for name, found in named.items()}
    for fine, coarse in permutations((name for name in spaces if spaces[name]), 2):
        for relation in (name for name in named if name not in (fine, coarse)):
            wholes = dict(named[relation])
            if {wholes.get(cell, "") for cell in spaces[fine]} <= set(spaces[coarse]):
                cells = {
                    place: tuple(cell for cell in spaces[fine] if wholes[cell] == place)
                    for place in spaces[coarse]
                }
                return Layout(_neighbours(spaces[coarse], named[coarse]), cells, wholes)
    widest = max(named, key=lambda name: len(named[name]) if spaces[name] else -1, default="")
    return Layout(_neighbours(spaces.get(widest, ()), named.get(widest, [])))


def pairs(atoms: Iterable[Literal]) -> list[Pair]:
    """The arguments of the two-place atoms."""
    found = (atom.arguments for atom in atoms)
    return [(args[0], args[1]) for args in found if len(args) == 2]


def _places(found: list[Pair], description: Description) -> tuple[str, ...]:
    """The smallest sort that has all the constants of the pairs."""
    joined = {constant for pair in found for constant in pair}
    sorts = [members for members in description.sorts.values() if joined <= set(members)]
    return min(sorts, key=len) if joined and sorts else ()


def _neighbours(places: tuple[str, ...], found: list[Pair]) -> dict[str, frozenset[str]]:
    return {
        place: frozenset({b for a, b in found if a == place} | {a for a, b in found if b == place})
        for place in places
    }
