"""The office by hand: states, transitions, sights and defaults, in Python.

It is written from the documents (D 1.1, 1.2; P 3.1.2) and reads no description, so that neither a
parser, nor a translation, nor a solver can be wrong in the same way.
"""

from collections import deque
from collections.abc import Iterable, Iterator, Mapping, Sequence
from functools import cached_property, lru_cache
from itertools import combinations, product
from typing import NamedTuple

from benchmarks.games.literals import ROBOT, ROOMS, SECURE, Literals, Plan, atom, next_to, parts


class State(NamedTuple):
    """Where the robot and each book are, the book in its hand, whether the library is locked.

    `sure` is what a checking robot is sure of (`CheckedOffice`).
    """

    robot: str
    places: tuple[str, ...]
    held: str | None
    locked: bool
    sure: frozenset[str] = frozenset()


class Office:
    """An office with these books. Of `shelved` ones it is known where they usually are.

    Each usually stands in one of its rooms, the first before others.
    """

    def __init__(
        self, books: Sequence[str], shelved: Mapping[str, Sequence[str]] | None = None
    ) -> None:
        self.books = tuple(books)
        self._number = {book: number for number, book in enumerate(books)}
        self.shelved = shelved
        self.after = lru_cache(200_000)(self._after)
        self.fluents = lru_cache(10_000)(self._fluents)
        self.compounds = lru_cache(20_000)(self._compounds)
        self._distances = lru_cache(256)(self._distances_to)

    @cached_property
    def states(self) -> tuple[State, ...]:
        """Every state."""
        every = product(ROOMS, product(ROOMS, repeat=len(self.books)), (None, *self.books), (0, 1))
        return tuple(
            State(robot, places, held, bool(locked))
            for robot, places, held, locked in every
            if held is None or places[self._number[held]] == robot
        )

    @cached_property
    def atoms(self) -> tuple[str, ...]:
        """The fluents in the order of declaration."""
        return (
            *(f"loc({thing},{room})" for thing in (*self.books, ROBOT) for room in ROOMS),
            *(f"in_hand({ROBOT},{book})" for book in self.books),
            f"locked({SECURE})",
        )

    @cached_property
    def defaults(self) -> tuple[str, ...]:
        """What holds where a default has an exception, in the order of the defaults."""
        found = [
            f"-loc({book},{rooms[number]})"
            for number in range(len(ROOMS))
            for book, rooms in (self.shelved or {}).items()
            if number < len(rooms) > 1
        ]
        alone = [
            f"-loc({b},{rooms[0]})" for b, rooms in (self.shelved or {}).items() if not rooms[1:]
        ]
        return (*found, *alone, f"locked({SECURE})")

    @cached_property
    def actions(self) -> tuple[str, ...]:
        """The robot's actions in the order of declaration."""
        return (
            *(f"move({ROBOT},{room})" for room in ROOMS),
            *(f"{name}({ROBOT},{book})" for name in ("pickup", "put_down") for book in self.books),
            f"unlock({ROBOT},{SECURE})",
        )

    @cached_property
    def events(self) -> tuple[str, ...]:
        """The exogenous actions in the order of declaration."""
        moves = (f"exo_move({book},{room})" for book in self.books for room in ROOMS)
        return (*moves, f"exo_lock({SECURE})")

    @cached_property
    def by_fluents(self) -> Mapping[frozenset[str], State]:
        """The states by what is true of them."""
        return {self.fluents(state): state for state in self.states}

    def _fluents(self, state: State) -> frozenset[str]:
        true = {f"loc({book},{room})" for book, room in zip(self.books, state.places, strict=True)}
        true.add(f"loc({ROBOT},{state.robot})")
        if state.held is not None:
            true.add(f"in_hand({ROBOT},{state.held})")
        return frozenset(true | ({f"locked({SECURE})"} if state.locked else set()))

    def agrees(self, state: State, literals: Iterable[str]) -> bool:
        """Whether all the literals hold."""
        true = self.fluents(state)
        return all((atom(each) in true) != each.startswith("-") for each in literals)

    def place(self, state: State, book: str) -> str:
        """The room of a book."""
        return state.places[self._number[book]]

    def possible(self, state: State, action: str) -> bool:
        """Whether no executability condition forbids the action."""
        name, arguments = parts(action)
        last = arguments[-1]
        robot, held, locked = state.robot, state.held, state.locked
        if name == "move":
            shut = locked and SECURE in (last, robot)
            return next_to(robot, last) and not shut
        if name == "unlock":
            return locked and (robot == last or next_to(robot, last))
        if name == "exo_lock":
            return not locked
        if name == "put_down":
            return held == last
        book = arguments[0] if name == "exo_move" else last
        place = self.place(state, book)
        if name == "pickup":
            return held is None and place == robot
        return last != place and held != book and not (locked and SECURE in (last, place))

    def _after(self, state: State, actions: frozenset[str]) -> State | None:
        """The successor of what happens at once; None where it cannot."""
        if not all(self.possible(state, action) for action in actions):
            return None
        robot, held, locked, places = state.robot, state.held, state.locked, {}
        for action in actions:
            name, arguments = parts(action)
            if name == "move":
                robot = arguments[-1]
            elif name == "pickup":
                held = arguments[-1]
            elif name == "put_down":
                held = None
            elif name == "exo_move":
                if arguments[0] in places:
                    return None  # in two rooms
                places[arguments[0]] = arguments[-1]
            else:
                locked = name == "exo_lock"
        if held is not None and places.setdefault(held, robot) != robot:
            return None  # in the hand, and elsewhere
        now = (places.get(b, at) for b, at in zip(self.books, state.places, strict=True))
        return State(robot, tuple(now), held, locked)

    def _compounds(self, state: State, most: int) -> tuple[frozenset[str], ...]:
        """At most so many events that may happen at once beside some action of the robot."""
        possible = [event for event in self.events if self.possible(state, event)]
        return tuple(
            frozenset(some)
            for number in range(min(most, len(self.books) + 1) + 1)
            for some in combinations(possible, number)
            if self.after(state, frozenset(some)) is not None
        )

    def visible(self, state: State) -> frozenset[str]:
        """The literals that the robot sees."""
        true = self.fluents(state)
        seen = [f"loc({ROBOT},{room})" for room in ROOMS]
        seen += [f"in_hand({ROBOT},{book})" for book in self.books]
        seen += [f"loc({book},{state.robot})" for book in self.books]
        if state.robot == SECURE or next_to(state.robot, SECURE):
            seen.append(f"locked({SECURE})")
        return frozenset(each if each in true else f"-{each}" for each in seen)

    def known(self, state: State, knows_all: bool) -> Literals:
        """What is known of the initial state: all of it, or what the robot sees."""
        true = self.fluents(state)
        whole = [each if each in true else f"-{each}" for each in self.atoms]
        return whole if knows_all else self.visible(state)

    def exceptions(self, state: State) -> frozenset[str]:
        """What holds at the start against a default."""
        if self.shelved is None:
            return frozenset()
        found = {f"locked({SECURE})"} if state.locked else set()
        for book, place in zip(self.books, state.places, strict=True):
            for room in () if book == state.held else self.shelved[book]:
                if place == room:
                    break
                found.add(f"-loc({book},{room})")
        return frozenset(found)

    def distances(self, goal: Literals) -> Mapping[State, int]:
        """The fewest actions of the robot that lead from a state to the goal; without: none do."""
        return self._distances(frozenset(goal))

    def _distances_to(self, goal: frozenset[str]) -> Mapping[State, int]:
        found = {state: 0 for state in self.states if self.agrees(state, goal)}
        waiting = deque(found)
        while waiting:
            state = waiting.popleft()
            for before in self._before[state]:
                if before not in found:
                    found[before] = found[state] + 1
                    waiting.append(before)
        return found

    @cached_property
    def _before(self) -> Mapping[State, list[State]]:
        found: dict[State, list[State]] = {state: [] for state in self.states}
        for state in self.states:
            for _, after in self.moves(state):
                found[after].append(state)
        return found

    def moves(self, state: State) -> Iterator[tuple[str, State]]:
        """The robot's possible actions in the order of declaration, with what they lead to."""
        for action in self.actions:
            after = self.after(state, frozenset([action]))
            if after is not None:
                yield action, after

    def shortest(self, state: State, goal: Literals) -> Plan | None:
        """The first shortest plan in the order of declaration; None: none of any length."""
        left, plan = self.distances(goal), list[str]()
        while left.get(state):
            steps = self.moves(state)
            action, state = next(x for x in steps if left.get(x[1]) == left[state] - 1)
            plan.append(action)
        return tuple(plan) if state in left else None


OFFICES: Mapping[str, Office] = {
    "office": Office(("book1", "book2")),
    "library": Office(
        ("book1", "book2", "cookbook1"),
        {"book1": (SECURE, "office1"), "book2": (SECURE, "office1"), "cookbook1": ("kitchen",)},
    ),
}
"""The packaged domains, by name."""
