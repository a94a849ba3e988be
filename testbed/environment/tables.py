"""Tables of a coarse game: what a step changes and shows, by the numbers of states and actions.

A position is what the rest of a game depends on besides the number of the step: the state of the
world, and whether a wrong `finish` has just been answered. Of state number s these are 2 s and
2 s + 1. What follows from a state is put into the tables when it is first asked for.
"""

from collections.abc import Iterable, Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from asp.language import Action
from testbed.environment.core import Core
from testbed.environment.legality import LegalEvents
from testbed.environment.observation import vector
from testbed.environment.rules import Ending, Rewards, Situation
from testbed.protocol import FINISH, NONE

ACHIEVED, FALSE_FINISH = 1, 2
ENDINGS = {ACHIEVED: Ending.ACHIEVED, FALSE_FINISH: Ending.FALSE_FINISH}
"""The endings by the robot's answer, by number; 0: it ends nothing."""
FIRST = 64
"""States for which there is room in the beginning."""
COPIED_AT_ONCE = (1, 2, 4, 8, 16, 32)
"""Bytes of a row that NumPy's `take` copies fastest: by one instruction, or a few."""


class TableError(ValueError):
    """A game that has no tables; one line says why."""


class Tables:
    """The tables of the games of a core, for S states, of which the number grows.

    With F fluents, R actions of the robot and E of the adversary, as the core lists them:

    - `following`, (2 S, R, E), of the smallest integers that hold positions: by position and both
      actions the position that follows, -1 where the event is illegal; where several may follow,
      which are in `several` by the place in the flat table, the first of them.
    - `ending`, (2 S, R) of int8: the number of the ending, 0 where the answer ends nothing.
    - `legal`, (S, R, E) of int8: 1 where the event is legal beside the robot's action.
    - `robot_sees`, (S, F) of int8, and `adversary_sees`, (S, R, F + R): their observations, the
      adversary's beside each action of the robot. These rows, and those of `legal`, may be followed
      by zeros, with which they are copied faster.

    Where `made`, (S,), is False, nothing is known of what follows from a state: `make` finds it
    out.

    Raises TableError for a game at the fine resolution, for one whose goal is drawn, for bounds of
    the adversary that depend on what was played, and for rewards other than zero-sum ones, which
    may have costs of steps and events.
    """

    def __init__(self, core: Core) -> None:
        if core.execution.sensing or core.execution.statistics:
            raise TableError("tables are of the coarse resolution; this game is of the fine one")
        if core.draw_goal is not None:
            raise TableError("tables are of one goal; the goal of this game is drawn")
        if core.allowance.highest:
            bounds = "adversary.budget, cooldown or per_object"
            raise TableError(f"tables know no history; drop {bounds}")
        own = core.rules.rewards
        if own != Rewards(step=own.step, discount=own.discount):
            raise TableError("tables are of zero-sum rewards; drop rewards.adversary and shaping")
        self.core = core
        self.states: list[int] = []
        self.several: dict[int, tuple[int, ...]] = {}
        self._numbers: dict[int, int] = {}
        self._known = 0
        fluents = len(core.world.fluents)
        robot, events = len(core.robot_actions), len(core.adversary_actions)
        self.made = np.zeros(FIRST, np.bool_)
        self.robot_sees = np.zeros((FIRST, _width(fluents)), np.int8)
        self.adversary_sees = np.zeros((FIRST, robot, _width(fluents + robot)), np.int8)
        self.legal = np.zeros((FIRST, robot, _width(events)), np.int8)
        self.ending = np.zeros((2 * FIRST, robot), np.int8)
        self.following = np.full((2 * FIRST, robot, events), -1, _kind(2 * FIRST))
        starts = () if callable(core.initial) else core.initial
        self.starts_at = 2 * np.array([*map(self.number, starts)], np.int64)

    @property
    def complete(self) -> bool:
        """Whether it is known of every state that is known what follows from it."""
        return self._known == len(self.states)

    def starts(self, random: np.random.Generator, number: int) -> NDArray[np.int64]:
        """So many positions, (number,), in which games may begin, drawn as by the core."""
        if callable(self.core.initial):
            drawn = [self.number(self.core.initial(random)) for _ in range(number)]
            return 2 * np.array(drawn, np.int64)
        return self.starts_at[random.integers(len(self.starts_at), size=number)]

    def decide(
        self, places: NDArray[np.int64], positions: NDArray[np.int64], random: np.random.Generator
    ) -> None:
        """Where several positions may follow by these places of `following`, put in one by draw."""
        if self.several:
            for row in np.flatnonzero(np.isin(places, np.fromiter(self.several, np.int64))):
                several = self.several[int(places[row])]
                positions[row] = several[random.integers(len(several))]

    def why_not(self, place: int) -> str:
        """Why nothing follows at a place of the flat table: one line."""
        position, own, other = map(int, np.unravel_index(place, self.following.shape))
        robot, event = self.core.robot_actions[own], self.core.adversary_actions[other]
        reason = self._events(self.states[position >> 1], robot).why_not(event)
        return f"{event} beside {robot}: {reason}"

    def number(self, state: int) -> int:
        """The number of a state of the world; one that has none gets the next."""
        if state not in self._numbers:
            if len(self.states) == len(self.made):
                self._make_room()
            self._numbers[state] = len(self.states)
            self.states.append(state)
            self._show(self._numbers[state], state)
        return self._numbers[state]

    def make(self, numbers: Iterable[int]) -> None:
        """Find out what follows from these states, where it is not known yet."""
        for number in numbers:
            if not self.made[number]:
                self._make(number)
                self.made[number] = True
                self._known += 1

    def make_all(self, states: Iterable[int]) -> None:
        """Find out what follows from these states of the world, and from all that follow."""
        for state in states:
            self.number(state)
        done = 0
        while done < len(self.states):
            self.make([done])
            done += 1

    def _make_room(self) -> None:
        """Twice as many rows in each table."""
        for name in ("made", "robot_sees", "adversary_sees", "legal", "ending", "following"):
            own = getattr(self, name)
            empty = np.full_like(own, -1 if name == "following" else 0)
            setattr(self, name, np.concatenate([own, empty]))
        self.following = self.following.astype(_kind(len(self.following)), copy=False)

    def _show(self, number: int, state: int) -> None:
        world = self.core.world
        fluents, robot = world.fluents, len(self.core.robot_actions)
        seen, end = vector(fluents, self.core.execution.visible(state)), len(fluents)
        self.robot_sees[number, :end] = seen
        self.adversary_sees[number, :, :end] = vector(fluents, world.literals(state))
        self.adversary_sees[number, :, end : end + robot] = np.eye(robot, dtype=np.int8)

    def _make(self, number: int) -> None:
        state, core = self.states[number], self.core
        for own, action in enumerate(core.robot_actions):
            events, endings = self._events(state, action), self._endings(state, action)
            self.ending[2 * number : 2 * number + 2, own] = endings
            for other, event in enumerate(core.adversary_actions):
                if not events.allows(event):
                    continue
                self.legal[number, own, other] = 1
                reached = [*map(self.number, self._reached(state, action, event))]
                for position, ending in zip((2 * number, 2 * number + 1), endings, strict=True):
                    answered = action == FINISH and not ending
                    self._follow(position, own, other, [2 * after + answered for after in reached])

    def _follow(self, position: int, own: int, other: int, following: Sequence[int]) -> None:
        self.following[position, own, other] = following[0]
        if len(following) > 1:
            place = np.ravel_multi_index((position, own, other), self.following.shape)
            self.several[int(place)] = tuple(following)

    def _endings(self, state: int, action: Action) -> tuple[int, int]:
        """The number of the ending by the robot's answer: at first, and after it was answered."""
        if action != FINISH:
            return 0, 0
        if self.core.world.satisfies(state, self.core.rules.goal):
            return ACHIEVED, ACHIEVED
        return 0 if self.core.rules.goal_feedback else FALSE_FINISH, FALSE_FINISH

    def _events(self, state: int, action: Action) -> LegalEvents:
        goal = self.core.rules.goal
        return self.core.legality.events(Situation("", 1, state, goal), action)

    def _reached(self, state: int, action: Action, event: Action) -> tuple[int, ...]:
        """The states of the world that may follow."""
        execution = self.core.execution
        effective = execution.physical(action) if execution.possible(state, action) else ()
        return self.core.world.successors(
            state, effective if event == NONE else (*effective, event)
        )


def _width(entries: int) -> int:
    """How many bytes a row of so many entries has."""
    return next((width for width in COPIED_AT_ONCE if width >= entries), entries)


def _kind(positions: int) -> np.dtype[Any]:
    """The smallest integers that hold so many positions, and -1: small tables stay in the cache."""
    return np.min_scalar_type(-positions)
