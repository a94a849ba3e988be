"""Planning problems: the four that prototypes were measured on, and generated ones."""

import random
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from functools import cached_property

from asp.language import Action, Description, Literal
from asp.reasoning import Knowledge, knowledge
from asp.solving import State
from benchmarks.offices import book_names, office, room_names


@dataclass(frozen=True)
class Problem:
    """Find a shortest plan in an office from the state with these true fluents to the goal."""

    name: str
    source: str
    initial: tuple[Literal, ...]
    goal: tuple[Literal, ...]
    limit: int = 60

    @cached_property
    def knowledge(self) -> Knowledge:
        return knowledge("office", self.source)

    @property
    def description(self) -> Description:
        return self.knowledge.description

    @property
    def state(self) -> State:
        return frozenset(self.initial)


def delivered(
    books: Sequence[str], room: str = "library", robot: str = "rob1"
) -> tuple[Action, ...]:
    """The goal that the books are in the room and not in the robot's hand."""
    there = tuple(Literal.of("loc", (book, room)) for book in books)
    return there + tuple(Literal.of("in_hand", (robot, book), False) for book in books)


def placed(where: dict[str, str], robot: str, *more: Literal) -> tuple[Literal, ...]:
    """The state with each book in its room and the robot in `robot`."""
    places = {**where, "rob1": robot}
    return (*(Literal.of("loc", place) for place in places.items()), *more)


LOCKED = Literal.of("locked", ("library",))


def prototypes() -> Iterator[Problem]:
    """P1 to P4: shortest plans of 6, 17, 32 and 19 actions."""
    yield Problem(
        "P1",
        office(2),
        placed(
            {"book1": "kitchen", "book2": "kitchen"},
            "kitchen",
            Literal.of("in_hand", ("rob1", "book1")),
        ),
        delivered(book_names(2)),
    )
    for name, books, lock in (("P2", 2, [LOCKED]), ("P3", 4, [])):
        where = dict.fromkeys(book_names(books), "office1")
        initial = placed(where, "library", *lock)
        yield Problem(name, office(books), initial, delivered(book_names(books)))
    rooms = room_names(4)
    spread = {book: rooms[number % 4] for number, book in enumerate(book_names(8))}
    initial = placed(spread, "library", LOCKED)
    yield Problem("P4", office(8), initial, delivered(["book1", "book2", "book3"]))


def drawn(
    books: int, rooms: int, shape: str, wanted: int, seed: int, number: int
) -> Iterator[Problem]:
    """Problems in one office from drawn states: the first `wanted` books go to the library."""
    source, names = office(books, rooms, shape), room_names(rooms)
    random_source = random.Random(seed)
    outside = names[:-1]
    for index in range(number):
        where = {book: random_source.choice(outside) for book in book_names(books)}
        lock = [LOCKED] if random_source.random() < 0.5 else []
        initial = placed(where, random_source.choice(outside), *lock)
        yield Problem(
            f"{books} books, {rooms} rooms in a {shape}, {wanted} wanted, {index + 1}",
            source,
            initial,
            delivered(book_names(wanted)),
        )
