"""Multi-shot sessions give the answers of the reference in offices of other sizes, too."""

import random

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from agents.intentional import IntentionalRobot
from asp.language import parse_description
from benchmarks.offices import book_names, office
from testbed.world import world_of
from tests.agents.intentional.lives import Place, Wish, live
from tests.agents.intentional.test_incremental import BOTH, wishes
from tests.literals import parsed


def made(books: int, rooms: int, shape: str, secure: int = 1) -> Place:
    """A generated office as a place to live in."""
    source = office(books, rooms, shape, secure)
    return Place("office", world_of(parse_description(source, "office.al")), source)


SMALL = made(1, 3, "row")
TREE = made(3, 5, "tree")
TWO_LOCKS = made(2, 5, "grid", secure=2)


def some_state(place: Place, seed: int) -> int:
    """A state drawn with the seed: things anywhere, locks locked or not, nothing in the hand."""
    rng = random.Random(seed)
    sorts = place.world.description.sorts
    true = parsed([f"loc({thing},{rng.choice(sorts['room'])})" for thing in sorts["thing"]])
    true += parsed([f"locked({room})" for room in sorts["secure_room"] if rng.random() < 0.5])
    return place.world.state(true)


@pytest.mark.parametrize("place", [SMALL, TREE, TWO_LOCKS], ids=["small", "tree", "two locks"])
@settings(max_examples=4)
@given(seed=st.integers(0, 1_000), wanted=st.integers(1, 2), wishes=wishes)
def test_every_decision_is_the_same_in_any_office(
    place: Place, seed: int, wanted: int, wishes: dict[int, Wish]
) -> None:
    books = book_names(len(place.world.description.sorts["book"]))[:wanted]
    locks = place.world.description.sorts["secure_room"]
    goal = parsed([f"loc({book},{locks[-1]})" for book in books])
    live(IntentionalRobot(BOTH), some_state(place, seed), goal, wishes, steps=16, where=place)
