"""Many coarse games at once, played by tables: a call takes a step of each."""

from typing import Any, NamedTuple

import numpy as np
from gymnasium.vector import AutoresetMode
from numpy.typing import ArrayLike, NDArray

from testbed.config import ConfigError
from testbed.environment import ADVERSARY, ROBOT, Ending, IllegalActionError, rewards
from testbed.environment.conventions import Conventions
from testbed.environment.rules import name_of
from testbed.environment.tables import ENDINGS, Tables
from testbed.office_v0 import Config, make_game, whole

Numbers = NDArray[np.int64]
Bytes = NDArray[np.int8]
Flags = NDArray[np.bool_]
HOW = (Ending.STEP_LIMIT, *ENDINGS.values())
"""How a game that has ended did, by the number of the ending by the robot's answer."""
NOBODY = np.empty(0, np.int64)


class Sight(NamedTuple):
    """What an agent sees of N games, as in the single environment.

    `observation`, (N, F) of int8, for the adversary (N, F + R); `action_mask`, (N, A) of int8, for
    F fluents, R actions of the robot, and A actions of the agent.
    """

    observation: Bytes
    action_mask: Bytes


class Moves(NamedTuple):
    """What came of a step of N games.

    `rewards`: by agent, (N,) of float32; `terminated` and `truncated`, (N,) of bool: whether the
    robot's answer, or the limit of steps, ended a game. `ended` are the numbers of the games that
    ended, in order, and `final`, by agent, the observations of their last moment.
    """

    rewards: dict[str, NDArray[np.float32]]
    terminated: Flags
    truncated: Flags
    ended: Numbers
    final: dict[str, Bytes]


class Batch:
    """N games under one configuration, of which a step is some operations of NumPy.

    `config` and `options` are those of `office_v0.env`, `games` is N. `autoreset_mode` is
    Gymnasium's: a game that ends begins anew in the same step (SAME_STEP); in the next one, which
    it does not play, whatever its answers (NEXT_STEP); or when `begin` is asked for (DISABLED). An
    answer is the number of an action in `robot_actions` or `adversary_actions`. All arrays that are
    returned are new. With `illegal="noop"` an event that is illegal counts as action 0.

    Raises:
        ConfigError: for a bad configuration, a number of games that is none, and for conventions
            that are not those of batches: `illegal="terminate"`, `padded=True`, `infos="text"`.
        TableError: for a game that tables cannot hold.
        ValueError: for what is no `autoreset_mode`.
    """

    def __init__(
        self,
        config: Config = None,
        games: int = 4096,
        *,
        seed: int | None = None,
        autoreset_mode: AutoresetMode = AutoresetMode.SAME_STEP,
        **options: Any,
    ) -> None:
        core, conventions = make_game(config, **options)
        _check(conventions)
        self._tolerates = conventions.illegal == "noop"
        self.games, self.autoreset_mode = whole("games", games), AutoresetMode(autoreset_mode)
        self.robot_actions, self.adversary_actions = core.robot_actions, core.adversary_actions
        self.fluents = core.world.fluents
        self.tables = Tables(core)
        self._limit, self._clock = core.rules.steps, 0
        self._per_step = np.float32(core.rules.rewards.step)
        self._per_event = np.float32(core.rules.adversary.cost)
        self._worth = np.array([rewards(how)[ROBOT] for how in HOW], np.float32)
        self._random, self._drawn = np.random.default_rng(seed), NOBODY
        self._position = np.zeros(games, np.int64)
        self._last = np.zeros(games, np.int64)  # what the clock shows at the last step of a game
        self._over = np.zeros(games, np.bool_)
        self._may_be_over = self.autoreset_mode is not AutoresetMode.SAME_STEP
        self.begin()

    @property
    def states(self) -> list[int]:
        """The state of each game, as the worlds of `testbed.world` have it."""
        return [self.tables.states[number] for number in self.numbers]

    @property
    def numbers(self) -> Numbers:
        """The number of each game's state in the tables, (N,)."""
        return self._position >> 1

    @property
    def steps(self) -> Numbers:
        """The step that each game is at, (N,); the first is 1."""
        return self._clock - self._last + self._limit

    @property
    def over(self) -> Flags:
        """Whether each game has ended, and not begun anew, (N,)."""
        return self._over.copy()

    def begin(self, which: ArrayLike | None = None, seed: int | None = None) -> None:
        """Begin games anew: all, or those where `which`, (N,), is true.

        With a seed, all draws from here on follow from it. Raises IllegalActionError for numbers of
        games in place of a mask.
        """
        mask = np.ones(self.games, np.bool_) if which is None else np.asarray(which)
        if mask.shape != (self.games,) or mask.dtype != np.bool_:
            wanted = f"give {self.games} truth values, one per game"
            raise IllegalActionError(f"begin: {mask.dtype} of shape {mask.shape}; {wanted}")
        if seed is not None:
            self._random, self._drawn = np.random.default_rng(seed), NOBODY
        self._begin(np.flatnonzero(mask))

    def robot_sight(self) -> Sight:
        """What the robot sees before it answers."""
        mask = np.ones((self.games, len(self.robot_actions)), np.int8)
        if self._may_be_over:
            mask[self._over, 1:] = 0
        seen = self.tables.robot_sees.take(self._position >> 1, axis=0)
        return Sight(seen[:, : len(self.fluents)], mask)

    def adversary_sight(self, robot_answers: ArrayLike) -> Sight:
        """What the adversary sees beside the robot's answers, (N,).

        Raises IllegalActionError for an answer that is no action.
        """
        answers, tables = self._numbers(ROBOT, robot_answers), self._prepared()
        beside = self._position >> 1
        beside *= len(self.robot_actions)
        beside += answers
        seen = _rows(tables.adversary_sees).take(beside, axis=0)
        mask = _rows(tables.legal).take(beside, axis=0)
        if self._may_be_over:
            mask[self._over, 1:] = 0
        entries = len(self.fluents) + len(self.robot_actions)
        return Sight(seen[:, :entries], mask[:, : len(self.adversary_actions)])

    def step(self, robot_answers: ArrayLike, events: ArrayLike) -> Moves:
        """Play a step of each game by the answers of both agents, (N,) each.

        Raises IllegalActionError, and plays nothing, for an answer that is no action, a game
        that is over and does not begin by itself, and an event that is illegal beside the robot's
        answer, unless that counts as action 0.
        """
        robot, event = self._numbers(ROBOT, robot_answers), self._numbers(ADVERSARY, events)
        anew = np.flatnonzero(self._over) if self._may_be_over else NOBODY
        if len(anew):
            robot, event = self._without(anew, robot, event)
        following, ending, event = self._played(robot, event)
        late = self._last <= self._clock
        self._position = following
        self._clock += 1
        if len(anew):
            ending[anew], late[anew] = 0, False
            self._begin(anew)
        terminated = ending != 0
        over = terminated | late
        ended = over.nonzero()[0]
        earned = self._earned(ended, ending.take(ended), event, anew)
        moves = Moves(earned, terminated, late > terminated, ended, self._final(ended))
        if self.autoreset_mode is AutoresetMode.SAME_STEP:
            self._begin(ended)
        else:
            self._over = over
        return moves

    def _played(self, robot: Numbers, event: Numbers) -> tuple[Numbers, Bytes, Numbers]:
        """The positions that follow, the endings by the robots' answers, and the events played."""
        tables = self._prepared()
        beside = self._position * len(self.robot_actions)
        beside += robot
        places = beside * len(self.adversary_actions)
        places += event
        follow = tables.following.reshape(-1)
        found = follow.take(places)
        if np.minimum.reduce(found) < 0:
            illegal = np.flatnonzero(found < 0)
            if not self._tolerates:
                game = int(illegal[0])
                raise IllegalActionError(f"game {game}: {tables.why_not(int(places[game]))}")
            places[illegal] -= event[illegal]
            event = event.copy()
            event[illegal] = 0
            found[illegal] = follow.take(places[illegal])
        following = found.astype(np.int64)
        tables.decide(places, following, self._random)
        return following, tables.ending.reshape(-1).take(beside), event

    def _earned(
        self, ended: Numbers, endings: Bytes, event: Numbers, unplayed: Numbers
    ) -> dict[str, NDArray[np.float32]]:
        """The rewards of a step after which these games ended like this: zero-sum but for costs."""
        robot = np.zeros(self.games, np.float32)
        robot[ended] = self._worth.take(endings)
        if self._per_step:
            robot -= self._per_step
            robot[unplayed] = 0
        adversary = 0 - robot
        if self._per_event:
            adversary -= self._per_event * (event > 0)
        return {ROBOT: robot, ADVERSARY: adversary}

    def _begin(self, games: Numbers) -> None:
        if len(games):
            self._position[games] = self._starts(len(games))
            self._last[games] = self._clock + self._limit - 1
            if self._may_be_over:
                self._over[games] = False

    def _starts(self, number: int) -> Numbers:
        """So many positions to begin in; many are drawn at once, which takes hardly longer."""
        if number > len(self._drawn):
            self._drawn = self.tables.starts(self._random, self.games)
        first, self._drawn = self._drawn[:number], self._drawn[number:]
        return first

    def _without(self, games: Numbers, robot: Numbers, event: Numbers) -> tuple[Numbers, Numbers]:
        """The answers, but of these games those that do nothing."""
        if self.autoreset_mode is AutoresetMode.DISABLED:
            raise IllegalActionError(f"game {games[0]} is over: begin it anew")
        both = robot.copy(), event.copy()
        for own in both:
            own[games] = 0
        return both

    def _numbers(self, agent: str, answers: ArrayLike) -> Numbers:
        given = np.asarray(answers)
        actions = self.robot_actions if agent == ROBOT else self.adversary_actions
        if given.shape != (self.games,) or given.dtype.kind not in "iu":
            wanted = f"give {self.games} integers, one per game"
            raise IllegalActionError(f"{agent}: {given.dtype} of shape {given.shape}; {wanted}")
        answers = given.astype(np.int64, copy=False)
        # As an unsigned number a negative one is large. `reduce`, as `max` comes with a wrapper.
        if np.maximum.reduce(answers.view(np.uint64)) >= len(actions):
            game = int(np.argmax((answers < 0) | (answers >= len(actions))))
            name_of(f"game {game}: {agent}", int(answers[game]), actions)
        return answers

    def _prepared(self) -> Tables:
        """The tables, with what follows from the states of the games."""
        if not self.tables.complete:
            self.tables.make(np.unique(self._position >> 1).tolist())
        return self.tables

    def _final(self, games: Numbers) -> dict[str, Bytes]:
        """What both see of games that have ended; the robot has no answer there any more."""
        number, tables = self._position.take(games) >> 1, self.tables
        end, robot = len(self.fluents), len(self.robot_actions)
        seen = tables.robot_sees.take(number, axis=0)
        everything = _rows(tables.adversary_sees).take(number * robot, axis=0)[:, : end + robot]
        everything[:, end:] = 0
        return {ROBOT: seen[:, :end], ADVERSARY: everything}


def _check(conventions: Conventions) -> None:
    """Raises ConfigError for conventions that a batch does not have."""
    lacking = {
        'illegal: "terminate"; give "error" or "noop"': conventions.illegal == "terminate",
        "padded: true; give false, and pad what a call returns": conventions.padded,
        'infos: "text"; a batch has no infos, give "numeric"': conventions.infos == "text",
    }
    found = [f"batch: does not play with {what}" for what, given in lacking.items() if given]
    if found:
        raise ConfigError(found)


def _rows(table: Bytes) -> Bytes:
    """A table by state and robot's action, (S, R, n), with one row for both, (S R, n)."""
    return table.reshape(-1, table.shape[-1])
