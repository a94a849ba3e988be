"""Planning problems at the fine resolution: transitions of levels, drawn with what is known."""

import random
from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property

from asp.domains import LevelSize, level_text
from asp.language import Action, Fluent, Literal
from asp.reasoning.fine_planning import FineStart
from asp.refinement import Refinement, Transition, fine_constants, fine_goal, load, relevant

_HELD = 0.4
_KINDS = ("move", "move", "pickup", "put_down")


@dataclass(frozen=True)
class FineProblem:
    """A coarse transition of a level, and what a robot may know of the state at its beginning."""

    refinement: Refinement
    start: FineStart
    transition: Transition
    relevant: frozenset[str]

    @cached_property
    def goal(self) -> tuple[Literal, ...]:
        """What the transition brings about."""
        effects, _ = fine_goal(self.refinement, self.transition, self.relevant)
        return effects

    @cached_property
    def constants(self) -> frozenset[str]:
        """Those of the zoomed description."""
        return self.relevant | fine_constants(self.refinement, self.relevant)


def refined(size: LevelSize) -> Refinement:
    """The refinement of a level of any size."""
    coarse, fine = level_text(size.rooms, size.rows, size.columns, size.objects)
    return load(coarse, "level.al", fine, "level.fine")


def drawn(refinement: Refinement, count: int, seed: int) -> list[FineProblem]:
    """So many transitions: half of them moves, the rest picking up and putting down.

    Of every object but the one in the hand the room is known, and of its cells that it is not in
    some; the goal is an object in another room.
    """
    draw = random.Random(seed)
    return [_problem(refinement, draw) for _ in range(count)]


def _problem(refinement: Refinement, draw: random.Random) -> FineProblem:
    sorts = refinement.coarse_signature.sorts
    kind = draw.choice(_KINDS)
    where = {thing: draw.choice(sorts["room"]) for thing in (*sorts["robot"], *sorts["object"])}
    (robot,) = sorts["robot"]
    held = kind == "put_down" or (kind == "move" and draw.random() < _HELD)
    item = draw.choice(sorts["object"])
    if held or kind == "pickup":
        where[item] = where[robot]
    in_hand = frozenset({Fluent.of("in_hand", (robot, item))})
    before = _coarse(where) | (in_hand if held else frozenset())
    if kind == "move":
        target = draw.choice(_neighbours(sorts["room"], where[robot]))
        moved = {robot: target} | ({item: target} if held else {})
        after = _coarse({**where, **moved}) | (before & in_hand)
        action = Action.of("move", (robot, target))
    else:
        after, action = before ^ in_hand, Action.of(kind, (robot, item))
    transition = Transition(before, action, after)
    other = draw.choice([room for room in sorts["room"] if room != where[item]])
    about = relevant(refinement, transition, (Fluent.of("loc", (item, other)),))
    start = _start(refinement, where, robot, item if held else None, draw)
    return FineProblem(refinement, start, transition, about)


def _start(
    refinement: Refinement,
    where: Mapping[str, str],
    robot: str,
    held: str | None,
    draw: random.Random,
) -> FineStart:
    components = refinement.components
    own = draw.choice(components[where[robot]])
    true, candidates = {Fluent.of("fine_loc", (robot, own))}, []
    for thing, room in where.items():
        if thing == robot:
            continue
        known_of = draw.randint(1, len(components[room]))
        left = set(draw.sample(components[room], known_of))
        for part in components[thing]:
            if thing == held:
                true.add(Fluent.of("fine_loc", (part, own)))
            else:
                group = (Fluent.of("fine_loc", (part, c)) for c in components[room] if c in left)
                candidates.append(tuple(group))
    if held is not None:
        true.add(Fluent.of("fine_in_hand", (robot, draw.choice(components[held]))))
    return FineStart(frozenset(true), tuple(candidates))


def _coarse(where: Mapping[str, str]) -> frozenset[Fluent]:
    return frozenset(Fluent.of("loc", place) for place in where.items())


def _neighbours(rooms: tuple[str, ...], room: str) -> list[str]:
    """Of rooms in a row."""
    at = rooms.index(room)
    return [rooms[n] for n in (at - 1, at + 1) if 0 <= n < len(rooms)]
