"""What it takes to ask for fair events, by the size of an office, beside asking for any."""

import time
from collections.abc import Iterator, Sequence
from itertools import cycle, islice
from random import Random

from asp.language import Action, Literal, parse_description
from benchmarks.measuring import no_collection
from benchmarks.offices import book_names, office, room_names
from benchmarks.sheets import Row, Sheet, gathered
from testbed.environment import Core, EventRules, Rules
from testbed.protocol import NONE
from testbed.search import cheapest_plan
from testbed.world import world_of

OFFICES = {"small": ((2, 4), (2, 8)), "full": ((2, 4), (4, 12), (8, 24), (12, 41))}
"""Books and rooms, in a row."""
STEPS = {"small": 6, "full": 20}
TRIED = 8
"""Events that are asked about at a step, until one is legal."""
NOTES = (
    "processor time per step to find a legal event at random, beside the actions of a plan;",
    "events: steps at which one was found. The first step of a large office makes its heuristics",
)


def main(size: str) -> list[Sheet]:
    """Sheet `fairness`."""
    rows = gathered(_row(*own, STEPS[size]) for own in OFFICES[size])
    return [Sheet("fairness", "Fair events by the size of an office", rows, NOTES)]


def _row(books: int, rooms: int, steps: int) -> Row:
    """One game with fair events, and one with any, step by step in turn."""
    world = world_of(parse_description(office(books, rooms), "office.al"))
    goal = tuple(Literal.parse(f"loc({book},library)") for book in book_names(books))
    start = [Literal.parse(own) for own in ("loc(rob1,kitchen)", *_places(books, rooms))]
    games = {
        name: Core(world, Rules(goal=goal, steps=10**6, adversary=EventRules(fair=fair)), ())
        for name, fair in {"any": False, "fair": True}.items()
    }
    plan = cheapest_plan((world, world.state(start), goal)) or ()
    took: dict[str, list[float]] = {name: [] for name in games}
    events = dict.fromkeys(games, 0)
    for core in games.values():
        core.reset(0, start)
    with no_collection():
        for number, action in enumerate(map(Literal.parse, islice(cycle(plan), steps))):
            for name, core in games.items():
                began = time.process_time()
                event = _legal(core, action, Random(number))
                took[name].append(1e3 * (time.process_time() - began))
                events[name] += event != NONE
                core.advance(action, event)
    row: dict[str, float] = {"books": books, "rooms": rooms, "plan": len(plan), "steps": steps}
    for name, own in took.items():
        row |= {f"{name}_events": events[name], f"{name}_ms": sum(own) / steps}
    return row | {"fair_longest_ms": max(took["fair"])}


def _places(books: int, rooms: int) -> Iterator[str]:
    """Where the books lie: all over the row."""
    names = room_names(rooms)[:-1]
    for number, book in enumerate(book_names(books)):
        yield f"loc({book},{names[(3 * number + 1) % len(names)]})"


def _legal(core: Core, action: Action, choose: Random) -> Action:
    """The first legal one of some events, drawn; `none` where none of them is."""
    tried: Sequence[Action] = choose.sample(core.adversary_actions[1:], k=TRIED)
    legal = core.legal_events(action)
    return next((event for event in tried if legal.allows(event)), Literal.parse(NONE))
