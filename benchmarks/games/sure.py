"""The office as a robot knows it that has to be sure of its goal, by hand."""

from collections.abc import Sequence
from functools import cached_property, lru_cache
from itertools import combinations

from benchmarks.games.literals import ROBOT, Literals, atom, complement, parts
from benchmarks.games.office import Office, State


class CheckedOffice(Office):
    """An office in which it is part of each state which literals of a goal a robot is sure of.

    It is sure of a literal that it knew at the start, or saw to be true, until it becomes false.
    `sure` has the literals by the names of these fluents, which are declared last.
    """

    def __init__(self, plain: Office, goal: Sequence[str]) -> None:
        super().__init__(plain.books, plain.shelved)
        self._plain = plain
        self.sure = {f"sure_{number}": literal for number, literal in enumerate(goal, start=1)}
        self.about = lru_cache(10_000)(self._about)

    def from_start(self, state: State) -> State:
        """The initial state, of which all is known."""
        return state._replace(sure=self.about(state)[0])

    @cached_property
    def states(self) -> tuple[State, ...]:
        return tuple(
            state._replace(sure=seen.union(more))
            for state in self._plain.states
            for true, seen in [self.about(state)]
            for number in range(len(true - seen) + 1)
            for more in combinations(sorted(true - seen), number)
        )

    @cached_property
    def atoms(self) -> tuple[str, ...]:
        return (*self._plain.atoms, *self.sure)

    def known(self, state: State, knows_all: bool) -> Literals:
        known = set(self._plain.known(state, knows_all))
        sure = [name for name, literal in self.sure.items() if literal in known]
        unsure = [f"-{n}" for n, literal in self.sure.items() if complement(literal) in known]
        return [*known, *sure, *unsure]

    def _about(self, state: State) -> tuple[frozenset[str], frozenset[str]]:
        """What the robot may be sure of in a state, and what it has to be sure of, as it sees it.

        A book that is in view it sees not to be in another room.
        """
        true = {n: each for n, each in self.sure.items() if self._plain.agrees(state, [each])}
        visible = self._plain.visible(state)

        def is_seen(literal: str) -> bool:
            name, (thing, *_) = parts(atom(literal))
            is_book = name == "loc" and thing != ROBOT
            return literal in visible or (is_book and self.place(state, thing) == state.robot)

        return frozenset(true), frozenset(n for n, each in true.items() if is_seen(each))

    def _fluents(self, state: State) -> frozenset[str]:
        return self._plain.fluents(state._replace(sure=frozenset())) | state.sure

    def _after(self, state: State, actions: frozenset[str]) -> State | None:
        after = self._plain.after(state._replace(sure=frozenset()), actions)
        if after is None:
            return None
        true, seen = self.about(after)
        return after._replace(sure=state.sure & true | seen)

    def _compounds(self, state: State, most: int) -> tuple[frozenset[str], ...]:
        return self._plain.compounds(state._replace(sure=frozenset()), most)
