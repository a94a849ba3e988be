"""The adversary's side of many games at once, as a Gymnasium vector environment."""

from collections.abc import Mapping
from functools import partial
from typing import Any, get_args

import gymnasium
import numpy as np
from gymnasium import spaces
from gymnasium.vector import AutoresetMode, SyncVectorEnv, VectorEnv
from gymnasium.vector.utils import batch_space
from numpy.typing import ArrayLike, NDArray

from testbed.config import ConfigError
from testbed.environment import (
    ADVERSARY,
    ROBOT,
    Ending,
    IllegalActionError,
    ResetOptionError,
    UnknownOptionError,
)
from testbed.environment.conventions import OUTCOMES
from testbed.environment.observation import Observation, Vector, vector
from testbed.learning.batch import Batch, Flags, Moves, Numbers
from testbed.learning.gymnasium_envs import Link
from testbed.learning.sides import Form, check_choice, of_scenario
from testbed.learning.table_robots import CHEAPEST, Table, is_table, table_of
from testbed.office_v0 import Config, raw_env, whole

RESET_MASK = "reset_mask"
UNKNOWN = -1
"""In place of an answer that has not been looked up yet."""


def make_vector(
    num_envs: int = 1,
    robot: str | Table = "intentional",
    autoreset_mode: AutoresetMode | str = AutoresetMode.NEXT_STEP,
    **options: Any,
) -> VectorEnv[Any, Any, Any]:
    """What `gymnasium.make_vec("testbed/Adversary-v0", num_envs)` makes.

    An `AdversaryVectorEnv` of a table robot; of a robot that reasons Gymnasium's `SyncVectorEnv`,
    whose games are played one after another. Options as for `AdversaryEnv`.
    """
    mode, num_envs = AutoresetMode(autoreset_mode), whole("num_envs", num_envs)
    if is_table(robot):
        return AdversaryVectorEnv(num_envs, robot, mode, **options)
    make = partial(gymnasium.make, "testbed/Adversary-v0", robot=robot, **options)
    return SyncVectorEnv([make] * num_envs, autoreset_mode=mode)


class AdversaryVectorEnv(VectorEnv[Any, Any, Any]):
    """The adversary's side of N games against a table robot, of which a step is a `Batch`'s.

    It returns the same as a `SyncVectorEnv` of N environments `AdversaryEnv`; draws are
    those of a batch. `reset` takes one seed, and of the options `reset_mask`, (N,) of bool: the
    games that begin anew.

    Raises:
        ConfigError: as `AdversaryEnv`, and for a render mode, and what a `Batch` does not have.
        TableError: for a game that tables cannot hold.
        RobotLost: by `reset` and `step`, where the robot's table lacks a state.
    """

    metadata: dict[str, Any] = {"render_modes": []}  # noqa: RUF012

    def __init__(
        self,
        num_envs: int = 1,
        robot: str | Table = CHEAPEST,
        autoreset_mode: AutoresetMode | str = AutoresetMode.NEXT_STEP,
        *,
        config: Config = None,
        scenario: str | None = None,
        observations: Form = "dict",
        render_mode: str | None = None,
        link: Link = "inprocess",
        **options: Any,
    ) -> None:
        check_choice("observations", observations, get_args(Form))
        check_choice("link", link, ("inprocess",))
        if not is_table(robot):
            raise _bad("robot", f"{robot!r} plays from no table; give '{CHEAPEST}', or a table")
        if render_mode is not None:
            raise _bad("render_mode", 'draws nothing; make it with vectorization_mode="sync"')
        read, _ = of_scenario(config, scenario, **options)
        mode = AutoresetMode(autoreset_mode)
        self._batch = Batch(read, whole("num_envs", num_envs), autoreset_mode=mode)
        self.num_envs, self.metadata = num_envs, {**self.metadata, "autoreset_mode": mode}
        core = self._batch.tables.core
        self._table, self._answers = table_of(robot, core), np.empty(0, np.int64)
        self._goal = vector(core.world.fluents, core.rules.goal)
        self._flat, self._tolerates = observations == "flat", read.illegal == "noop"
        self._per_step, self._begun = core.rules.rewards.step, False
        side = raw_env(read)
        known = side.observation_space(ADVERSARY)
        assert isinstance(known, spaces.Dict)
        self.single_observation_space = known["observation"] if self._flat else known
        self.single_action_space = side.action_space(ADVERSARY)
        self.observation_space = batch_space(self.single_observation_space, num_envs)
        self.action_space = batch_space(self.single_action_space, num_envs)

    def reset(
        self, *, seed: int | None = None, options: dict[str, Any] | None = None
    ) -> tuple[Observation | Vector, dict[str, Any]]:
        """Begin all games, or those of `reset_mask`; the infos are of these."""
        chosen = {} if options is None else options
        if not isinstance(chosen, Mapping):
            raise ResetOptionError(f"reset: options should be a dictionary, not {options!r}")
        if unknown := [key for key in chosen if key != RESET_MASK]:
            raise UnknownOptionError(f"reset: {unknown[0]!r} is not an option; give '{RESET_MASK}'")
        super().reset(seed=seed)
        which = np.asarray(chosen.get(RESET_MASK, np.ones(self.num_envs, np.bool_)))
        self._batch.begin(which, seed)
        self._look()
        nothing = np.zeros(self.num_envs, np.int64)
        return self._seen(), _told(self._infos(nothing, nothing.copy()), which)

    def step(
        self, actions: ArrayLike
    ) -> tuple[Observation | Vector, NDArray[np.float64], Flags, Flags, dict[str, Any]]:
        """Play a step of each game.

        Raises IllegalActionError, and plays nothing, before `reset`, after an error of the robot,
        and as `Batch.step`.
        """
        if not self._begun:
            raise IllegalActionError("no games are under way: reset the environment")
        batch, events, steps = self._batch, np.asarray(actions), self._batch.steps
        moves = batch.step(self._robot, events)
        illegal, outcomes = self._illegal(events), _outcomes(moves, self._per_step)
        final = {}
        if batch.autoreset_mode is AutoresetMode.SAME_STEP and len(moves.ended):
            final = self._final(moves, steps + 1, outcomes, illegal)
            illegal[moves.ended] = outcomes[moves.ended] = 0
        self._look()
        infos = _told(self._infos(outcomes, illegal), np.ones(self.num_envs, np.bool_))
        earned = moves.rewards[ADVERSARY].astype(np.float64)
        return self._seen(), earned, moves.terminated, moves.truncated, {**final, **infos}

    def action_masks(self) -> Flags:
        """The legal actions, (N, A) of bool. Raises IllegalActionError before `reset`."""
        if not self._begun:
            raise IllegalActionError("no games are under way: reset the environment")
        return self._legal.astype(np.bool_)

    def _look(self) -> None:
        """Let the robot answer in each game that is not over."""
        batch, self._begun = self._batch, False
        self._over = batch.over
        states, numbers = batch.tables.states, batch.numbers
        if lacking := len(states) - len(self._answers):
            self._answers = np.append(self._answers, np.full(lacking, UNKNOWN))
        answers = self._answered(numbers)
        if answers.min() == UNKNOWN:
            for number in np.unique(numbers[answers == UNKNOWN]):
                self._answers[number] = self._table[states[number]]
            answers = self._answered(numbers)
        self._robot, self._begun = answers, True
        self._everything, self._legal = batch.adversary_sight(answers)
        if self._over.any():
            self._everything[self._over, len(batch.fluents) :] = 0

    def _answered(self, numbers: Numbers) -> Numbers:
        answers = self._answers.take(numbers)
        answers[self._over] = 0
        return answers

    def _seen(self) -> Observation | Vector:
        if self._flat:
            return self._everything
        return {"observation": self._everything, "action_mask": self._legal.copy()}

    def _illegal(self, events: Numbers) -> Numbers:
        """Whether the events were illegal beside the robot's answers, which nothing else allows."""
        if not self._tolerates:
            return np.zeros(self.num_envs, np.int64)
        legal = np.take_along_axis(self._legal, events[:, None], axis=1)[:, 0]
        illegal: Numbers = ((legal == 0) & ~self._over).astype(np.int64)
        return illegal

    def _infos(self, outcomes: Numbers, illegal: Numbers) -> dict[str, NDArray[Any]]:
        """The infos of the single environment, with a row per game."""
        return {
            "step": self._batch.steps,
            "outcome": outcomes,
            "goal": np.tile(self._goal, (self.num_envs, 1)),
            "robot_action": np.where(self._over, -1, self._robot),
            "illegal": illegal,
        }

    def _final(
        self, moves: Moves, steps: Numbers, outcomes: Numbers, illegal: Numbers
    ) -> dict[str, Any]:
        """What is told of the last moment of games that have begun anew."""
        ended = np.zeros(self.num_envs, np.bool_)
        ended[moves.ended] = True
        seen = np.full(self.num_envs, None)
        mask = np.eye(1, self._legal.shape[1], dtype=np.int8)[0]
        for game, row in zip(moves.ended, moves.final[ADVERSARY], strict=True):
            seen[game] = row if self._flat else {"observation": row, "action_mask": mask.copy()}
        unanswered = np.full(self.num_envs, -1)
        last = {**self._infos(outcomes.copy(), illegal.copy()), "step": steps}
        told = _told({**last, "robot_action": unanswered}, ended)
        both = {"final_obs": seen, "final_info": told}
        return {**both, "_final_obs": ended, "_final_info": ended.copy()}


def _outcomes(moves: Moves, per_step: float) -> Numbers:
    """The outcomes by number, as numeric infos have them, where a step costs the robot this."""
    ended, outcomes = moves.ended, np.zeros(len(moves.terminated), np.int64)
    achieved = moves.rewards[ROBOT][ended] + per_step > 0
    by_answer = np.where(achieved, *map(OUTCOMES.index, (Ending.ACHIEVED, Ending.FALSE_FINISH)))
    limit = OUTCOMES.index(Ending.STEP_LIMIT)
    outcomes[ended] = np.where(moves.truncated[ended], limit, by_answer)
    return outcomes


def _told(infos: dict[str, NDArray[Any]], which: Flags) -> dict[str, Any]:
    """Infos of these games as Gymnasium has them: by key an array, and whether a game has it."""
    told: dict[str, Any] = {}
    for key, rows in infos.items():
        rows[~which] = 0
        told[key], told[f"_{key}"] = rows, which.copy()
    return told


def _bad(key: str, what: str) -> ConfigError:
    return ConfigError([f"keyword argument: {key}: {what}"])
