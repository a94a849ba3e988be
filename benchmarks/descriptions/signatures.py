"""Random signatures: sorts in a hierarchy, and the symbols that there is room for."""

from collections.abc import Iterator, Sequence
from math import prod
from random import Random

from benchmarks.descriptions.journeys import random_journey
from benchmarks.descriptions.text import Description, Parts, Symbol

ROBOT, ROBOTS = "crab", "claw"
_LEAVES = ("shell", "kelp", "reef")
_CONSTANTS = {"shell": ("conch", "whelk"), "kelp": ("frond", "stalk"), "reef": ("1", "2", "3")}
_NAMES = {
    "static": ("near", "odd"),
    "inertial": ("open", "upon", "wet", "bound"),
    "defined": ("calm", "safe"),
    "agent": ("shift", "knot", "tap"),
    "exogenous": ("surge", "drip"),
}
_LEAST = {"inertial": 2, "agent": 2, "exogenous": 1}
"""The fewest symbols of a kind, if there is room for them."""
_MOST = {"static": 6, "inertial": 6, "defined": 3, "agent": 7, "exogenous": 3}
"""The most ground symbols of a kind; those of a journey count half."""


def random_signature(random: Random) -> Description:
    """Sorts and symbols, in half of the cases those of a journey first, with what they do."""
    sorts = Description(_sorts(random))
    journey = random_journey(sorts, ROBOTS, random) if random.random() < 0.5 else None
    given = journey or sorts
    symbols = (*given.symbols, *_symbols(sorts, given.symbols, random))
    return Description(sorts.sorts, symbols, given.statements)


def _sorts(random: Random) -> dict[str, Parts]:
    """The robot's sort, one to three others, and perhaps unions of these."""
    sorts: dict[str, Parts] = {ROBOTS: ((ROBOT,),)}
    for leaf in _LEAVES[: random.choice([1, 2, 2, 3])]:
        sorts[leaf] = (_CONSTANTS[leaf][: random.choice([1, 2, 2, 3])],)
    leaves = [*sorts][1:]
    if len(leaves) > 1 and random.random() < 0.6:
        sorts["find"] = (leaves[0], leaves[1])
    if random.random() < 0.3:
        sorts["being"] = (ROBOTS, random.choice([*sorts][1:]))
    if random.random() < 0.2:
        sorts["rare"] = ((_CONSTANTS[leaves[0]][0],), leaves[-1])
    return sorts


def _symbols(sorts: Description, given: Sequence[Symbol], random: Random) -> Iterator[Symbol]:
    """Symbols beside those that are given, as many as there is room for."""

    def size(drawn: Sequence[str]) -> int:
        return prod(len(sorts.members(sort)) for sort in drawn)

    changed = [symbol.sorts for symbol in given if symbol.kind == "inertial"]
    for kind, names in _NAMES.items():
        left = _MOST[kind] - sum(size(own.sorts) for own in given if own.kind == kind) // 2
        for name in names[: random.randint(_LEAST.get(kind, 0), len(names))]:
            arity = random.choice([0, 1, 1, 2] if kind != "static" else [1, 2, 2])
            drawn = tuple(random.choice([*sorts.sorts]) for _ in range(arity))
            if kind in ("agent", "exogenous") and random.random() < 0.7:
                drawn = max(random.choices(changed, k=2), key=len)
            while drawn and size(drawn) > left:
                drawn = drawn[1:]
            if left > 0 and (drawn or kind != "static"):
                left -= size(drawn)
                changed += [drawn] if kind == "inertial" else []
                yield Symbol(kind, name, drawn)
