"""A part that many descriptions have: who is where, the ways there, and who goes along them."""

from collections.abc import Iterator
from itertools import pairwise
from random import Random

from benchmarks.descriptions.text import EQUAL, Atom, Description, Statement, Symbol

JOURNEY = frozenset({"path", "at", "go", "drift"})
"""The names of its symbols."""

_THERE = Atom("at", ("X", "P"))
_ELSEWHERE = Atom("at", ("X", "Q"))


def random_journey(sorts: Description, robots: str, random: Random) -> Description | None:
    """Symbols and statements about the places of one of the sorts; None where none has several.

    The robot goes from place to place. Of a sort with the robot others may be carried off, too.
    """
    places = [sort for sort in sorts.sorts if 1 < len(sorts.members(sort)) < 4]
    if not places:
        return None
    place = random.choice(places)
    robot, *_ = sorts.members(robots)
    bodies = [
        sort
        for sort in sorts.sorts
        if robot in sorts.members(sort) and len(sorts.members(sort)) * len(sorts.members(place)) < 7
    ]
    body = random.choice(bodies)
    symbols = [
        Symbol("static", "path", (place, place)),
        Symbol("inertial", "at", (body, place)),
        Symbol("agent", "go", (robots, place)),
        Symbol("exogenous", "drift", (body, place)),
    ]
    kept = symbols if random.random() < 0.6 else symbols[:-1]
    return Description({}, tuple(kept), tuple(_statements(sorts, place, kept, random)))


def _statements(
    sorts: Description, place: str, symbols: list[Symbol], random: Random
) -> Iterator[Statement]:
    members = sorts.members(place)
    for one, other in pairwise(members):
        yield Statement("fact", (Atom("path", (one, other)),))
    if random.random() < 0.8:
        yield Statement("law", (Atom("path", ("P", "Q")),), (Atom("path", ("Q", "P")),))
    no_way = Atom("path", ("Q", "P"), positive=False)
    unequal = Atom(EQUAL, ("P", "Q"), positive=False)
    yield Statement("law", (_ELSEWHERE._replace(positive=False),), (_THERE, unequal))
    for symbol in symbols:
        if symbol.kind in ("agent", "exogenous"):
            action = Atom(symbol.name, ("X", "P"))
            yield Statement("causes", (action, _THERE))
            yield Statement("impossible", (action,), (_THERE,))
            if random.random() < 0.7:
                yield Statement("impossible", (action,), (_ELSEWHERE, no_way))
    if random.random() < 0.8:
        yield Statement("some", (_THERE,), name="P")
    if random.random() < 0.8:
        yield Statement("sees", (_THERE,), name=random.choice(sorts.members(symbols[2].sorts[0])))
