"""What stands in a drawing beside its places: notes on things, towers, and what differs."""

from collections.abc import Collection, Iterable, Mapping, Sequence
from dataclasses import dataclass, field

from asp.language import Fluent, Literal
from testbed.environment.rendering.scene import Scene


@dataclass(frozen=True)
class Contents:
    """The true fluents that places do not show, each at one place of the drawing.

    `notes` are said of things by name, `above` is what stands on what where there are no places
    (`relation` says how), and `rest` are the other fluents. `differs` has the names of what is not
    so, the fluents of `rest` and the pairs of a place and its mark among them; `missing` are
    literals that are so and of which nothing is drawn.
    """

    notes: Mapping[str, list[str]]
    relation: str
    above: Mapping[str, list[str]]
    rest: list[Fluent]
    differs: Collection[object] = field(default_factory=set)
    missing: Sequence[Literal] = ()

    @property
    def standing(self) -> list[Fluent]:
        """The fluents that say what stands on what."""
        pairs = [(upper, lower) for lower, uppers in self.above.items() for upper in uppers]
        return [Fluent(self.relation, pair) for pair in pairs]

    @property
    def ground(self) -> list[str]:
        """What stands on nothing, and something on it."""
        standing = {one for ones in self.above.values() for one in ones}
        return [name for name in self.above if name not in standing]


def contents(scene: Scene, marked: Iterable[Literal]) -> Contents:
    """The contents of a scene in which these literals differ from what is true elsewhere."""
    robots = {robot for place in scene.places for robot in place.robots}
    held = {t for place in scene.places for things in place.robots.values() for t in things}
    drawn = robots | held | {thing for place in scene.places for thing in place.things}
    relation, above = ("", {}) if scene.places else _towers(scene.rest)
    drawn |= {*above, *(one for ones in above.values() for one in ones)}
    notes: dict[str, list[str]] = {}
    rest = []
    for fluent in scene.rest:
        if fluent.name == relation and len(fluent.arguments) == 2:
            continue
        if fluent.arguments and fluent.arguments[0] in drawn:
            name, *others = fluent.arguments
            notes.setdefault(name, []).append(" ".join([fluent.name, *others]))
        else:
            rest.append(fluent)
    differs: set[object] = set()
    missing = []
    places = {place.name for place in scene.places}
    for literal in marked:
        atom = literal if literal.is_positive else literal.complement
        match atom.arguments:
            case (place,) if place in places:
                differs.add((place, atom.name))
            case (holder, name) if holder in robots and name in drawn:
                differs.add(name)
            case (name, *_) if name in drawn:
                differs.add(name)
            case _ if atom in rest:
                differs.add(atom)
            case _:
                missing.append(literal)
    return Contents(notes, relation, above, rest, differs, missing)


def _towers(fluents: Sequence[Fluent]) -> tuple[str, dict[str, list[str]]]:
    """Of the relations that can be seen as standing on each other that which says most.

    It is the first one declared of those that say as much. In one of these each thing stands on one
    other at most, and none on itself, however far down.
    """
    found: dict[str, list[Fluent]] = {}
    for fluent in fluents:
        if len(fluent.arguments) == 2:
            found.setdefault(fluent.name, []).append(fluent)
    for name in sorted(found, key=lambda name: -len(found[name])):
        below = {f.arguments[0]: f.arguments[1] for f in found[name]}
        if len(below) == len(found[name]) and all(_ends(one, below) for one in below):
            above: dict[str, list[str]] = {lower: [] for lower in below.values()}
            for upper, lower in below.items():
                above[lower].append(upper)
            return name, above
    return "", {}


def _ends(name: str, below: Mapping[str, str]) -> bool:
    """Whether the way down from a thing ends."""
    seen = {name}
    while name in below:
        name = below[name]
        if name in seen:
            return False
        seen.add(name)
    return True
