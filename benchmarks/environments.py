"""Half steps per second of processor time of AEC environments, raw, all in one interleaved run."""

import time
from collections.abc import Callable, Iterator, Mapping
from importlib.util import find_spec
from typing import Any

import numpy as np
from pettingzoo import AECEnv

from benchmarks.measuring import median
from benchmarks.sheets import Row, Sheet, gathered
from testbed import office_v0
from testbed.environment import ADVERSARY, ROBOT

STEPS = {"small": 300, "full": 40_000}
ROUNDS = {"small": 2, "full": 9}
WARM = {"small": 300, "full": 100_000}
"""Half steps of the office that are played first: their tables are made."""
FLUENTS, ACTIONS, LENGTH = 15, 11, 40


class Empty(AECEnv[str, Any, int | None]):
    """What any AEC environment takes: two agents in turn, new arrays as observations."""

    def __init__(self) -> None:
        self.possible_agents = [ROBOT, ADVERSARY]
        self._seen = np.zeros(FLUENTS, np.int8)
        self._mask = np.ones(ACTIONS, np.int8)

    def reset(self, seed: int | None = None, options: dict[str, Any] | None = None) -> None:
        del seed, options
        self.agents, self._step = list(self.possible_agents), 0
        self.agent_selection = ROBOT
        self.rewards = dict.fromkeys(self.agents, 0.0)
        self._cumulative_rewards = dict.fromkeys(self.agents, 0.0)
        self.terminations = dict.fromkeys(self.agents, False)
        self.truncations = dict.fromkeys(self.agents, False)
        self.infos: dict[str, dict[str, Any]] = {agent: {} for agent in self.agents}

    def observe(self, agent: str) -> dict[str, Any]:
        del agent
        return {"observation": self._seen.copy(), "action_mask": self._mask.copy()}

    def step(self, action: int | None) -> None:
        del action
        self._step += 1
        self.agent_selection = ADVERSARY if self.agent_selection == ROBOT else ROBOT
        if self._step >= LENGTH:
            self.truncations = dict.fromkeys(self.agents, True)


def main(size: str) -> list[Sheet]:
    """Sheet `environments`: a row per environment, beside the office."""
    notes = (
        "last(), a pick by integers() over the non-zeros of the mask, step(); resets included;",
        "medians of rounds, in each of which all play in turn; share: the office's by this rate",
    )
    rows = gathered(_rows(STEPS[size], ROUNDS[size], WARM[size]))
    return [Sheet("environments", "Raw AEC environments, half steps per second", rows, notes)]


def _rows(steps: int, rounds: int, warm: int) -> Iterator[Row]:
    envs = {name: make() for name, make in _makers().items()}
    _rate(envs["office"], warm, 0)
    rates = {name: list[float]() for name in envs}
    for number in range(1, rounds + 1):
        for name, env in envs.items():
            rates[name].append(_rate(env, steps, number))
    for name, own in rates.items():
        shares = [office / other for office, other in zip(rates["office"], own, strict=True)]
        yield {"environment": name, "per_s": median(own), "share": median(shares)}


def _makers() -> Mapping[str, Callable[[], AECEnv[str, Any, Any]]]:
    """tictactoe_v3 needs pygame, which the extra `bench` installs."""
    own: dict[str, Callable[[], AECEnv[str, Any, Any]]] = {
        "office": lambda: office_v0.raw_env("office"),
        "empty": Empty,
    }
    if find_spec("pygame") is not None:
        from pettingzoo.classic.tictactoe import tictactoe  # noqa: PLC0415  # of the extra

        own["tictactoe_v3"] = tictactoe.raw_env
    return own


def _rate(env: AECEnv[str, Any, Any], steps: int, seed: int) -> float:
    random, over, played = np.random.default_rng(seed), True, 0
    began = time.process_time()
    while played < steps:
        if over:
            env.reset()
        observation, _, ended, cut, _ = env.last()
        over = ended or cut
        if not over:
            assert observation is not None
            legal = observation["action_mask"].nonzero()[0]
            env.step(int(legal[random.integers(len(legal))]))
            played += 1
    return steps / (time.process_time() - began)
