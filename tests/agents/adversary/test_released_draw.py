"""The office's drawn events against the table of the released simulator, in plain Python.

Exact probabilities, in each of the 192 states, beside each action that the robot may attempt.
"""

from collections.abc import Iterator
from dataclasses import dataclass
from fractions import Fraction
from itertools import product

import pytest

from testbed.protocol import NONE
from testbed.world import World, load_world
from tests.agents.adversary.chances import chances

BOOKS, ROOMS = ("book1", "book2"), ("library", "kitchen", "office1", "office2")
THIRD = Fraction(1, 3)
Chances = dict[str, Fraction]


@dataclass(frozen=True)
class Office:
    """A state: where the robot and each book are, what is in the hand, whether the lock is shut."""

    robot: str
    places: dict[str, str]
    hand: str | None
    locked: bool

    @property
    def literals(self) -> list[str]:
        places = [f"loc({book},{room})" for book, room in self.places.items()]
        hand = [] if self.hand is None else [f"in_hand(rob1,{self.hand})"]
        return [f"loc(rob1,{self.robot})", *places, *hand, *["locked(library)"] * self.locked]


def offices() -> Iterator[Office]:
    for robot, one, two in product(ROOMS, repeat=3):
        for hand, locked in product((None, *BOOKS), (False, True)):
            places = dict(zip(BOOKS, (one, two), strict=True))
            if hand is None or places[hand] == robot:
                yield Office(robot, places, hand, locked)


def drawn_books(taken: str | None) -> Chances:
    """Each book by how likely it is drawn; one that is taken passes the draw on to the other."""
    if taken is None:
        return dict.fromkeys(BOOKS, Fraction(1, 2))
    return {book: Fraction(1) for book in BOOKS if book != taken}


def to_elsewhere(office: Office, book: str, share: Fraction) -> Chances:
    """The book to one of the three other rooms, a third each; nothing where the lock forbids it."""
    now = office.places[book]
    return {
        f"exo_move({book},{room})": share * THIRD
        for room in ROOMS
        if room != now and not (office.locked and "library" in (now, room))
    }


def table(scenario: str, office: Office, verb: str, about: str) -> Chances:
    """The table of the specification: events by probability, once one is tried."""
    picking = about if verb == "pickup" else None
    destination = about if verb == "move" else office.robot
    found: Chances = {}
    if scenario == "random" and not office.locked:
        found["exo_lock(library)"] = THIRD
    if scenario != "random" and (verb == "unlock" or destination == "library"):
        return found
    taken = office.hand or (None if scenario == "4" else picking)
    for book, share in drawn_books(taken).items():
        here = office.places[book] == destination
        shut = office.locked and office.places[book] == "library"
        if scenario == "random":
            found |= to_elsewhere(office, book, share * 2 * THIRD)
        elif scenario == "3" and here:
            found |= to_elsewhere(office, book, share)
        elif scenario == "4" and not here and not shut:
            found[f"exo_move({book},{destination})"] = share
    return found


def attempts(world: World, office: Office) -> Iterator[tuple[str, str]]:
    """What the robot can do, and moves that only the lock makes fail."""
    state = world.state(office.literals)
    for action in world.agent_actions:
        locked_out = office.locked and action.name == "move" and action.arguments[1] != office.robot
        if locked_out or world.executable(state, [action]):
            yield action.name, action.arguments[1]


@pytest.mark.parametrize("scenario", ["3", "4", "random"])
def test_events_are_as_likely_as_in_the_table(
    scenario: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    world, asked = load_world("office"), 0
    for office in offices():
        for verb, about in attempts(world, office):
            action = f"{verb}(rob1,{about})"
            ours = chances(world, scenario, office.literals, action, monkeypatch)
            nothing = ours.pop(NONE, Fraction(0))
            assert ours == table(scenario, office, verb, about), (office, action)
            assert nothing == 1 - sum(ours.values())
            asked += 1
    assert len(list(offices())) == 192
    assert asked > 192


@pytest.mark.parametrize(("state", "books"), [(0, 2), (1, 1)])
def test_of_possible_events_a_held_book_takes_its_share_in_vain(
    state: int, books: int, monkeypatch: pytest.MonkeyPatch
) -> None:
    """`random-possible`: each of the things a third, and of it only what can be done to it."""
    office = Office("kitchen", dict(zip(BOOKS, ("kitchen", "office1"), strict=True)), None, True)
    if state:
        office = Office(office.robot, office.places, "book1", True)
    world, action = load_world("office"), "unlock(rob1,library)"
    ours = chances(world, "random-possible", office.literals, action, monkeypatch)
    assert ours.pop(NONE) == 1 - books * THIRD
    assert len(ours) == 2 * books
    assert set(ours.values()) == {THIRD / 2}
