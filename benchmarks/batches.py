"""Many games at once: transitions per second of processor time, beside the single environment."""

import time
from collections.abc import Iterator

import numpy as np
from numpy.typing import NDArray

from benchmarks.sheets import Row, Sheet, gathered
from testbed.environment import ADVERSARY, ROBOT
from testbed.learning import Batch
from testbed.office_v0 import raw_env

GAMES = (1024, 4096, 16384, 65536)
TRANSITIONS = {"small": 20_000, "full": 20_000_000}
SINGLE = {"small": 200, "full": 20_000}
ROUNDS = {"small": 1, "full": 5}


def main(size: str) -> list[Sheet]:
    """Sheet `batches`: a row per number of games."""
    return [
        Sheet(
            "batches",
            "Transitions of the office per second of processor time, millions",
            gathered(_rows(size)),
            (
                "a transition: both observations and masks, the step, rewards, endings, resets;",
                "what picks the answers, at random among the legal ones, is not counted;",
                "first: with the tables made on the way; single: the AEC environment, raw, between",
            ),
        )
    ]


def _rows(size: str) -> Iterator[Row]:
    for games in GAMES:
        steps = max(1, TRANSITIONS[size] // games // ROUNDS[size])
        first = _rate(Batch(games=games, seed=0), 1)
        batch, rates, singles = Batch(games=games, seed=0), [], []
        _rate(batch, 50)
        for _ in range(ROUNDS[size]):
            rates.append(_rate(batch, steps))
            singles.append(_single_rate(SINGLE[size] // ROUNDS[size]))
        yield {
            "games": games,
            "states": len(batch.tables.states),
            "first": first / 1e6,
            "batch": float(np.median(rates)) / 1e6,
            "single": float(np.median(singles)) / 1e6,
            "times_faster": float(np.median(np.divide(rates, singles))),
        }


def _rate(batch: Batch, steps: int) -> float:
    """Transitions per second over so many steps of all games."""
    random, taken = np.random.default_rng(1), 0.0
    for _ in range(steps):
        robot = random.integers(len(batch.robot_actions), size=batch.games)
        began = time.process_time()
        batch.robot_sight()
        mask = batch.adversary_sight(robot).action_mask
        taken += time.process_time() - began
        event = _picked(mask, random)
        began = time.process_time()
        batch.step(robot, event)
        taken += time.process_time() - began
    return steps * batch.games / taken


def _picked(masks: NDArray[np.int8], random: np.random.Generator) -> NDArray[np.int64]:
    """A legal answer of each game, found in few bytes: what fills the caches slows the batch."""
    legal = masks.cumsum(axis=1, dtype=np.int8)
    drawn = random.integers(legal[:, -1], dtype=np.int8)
    picked: NDArray[np.int64] = (legal > drawn[:, None]).argmax(axis=1)
    return picked


def _single_rate(steps: int) -> float:
    env, random, taken = raw_env(), np.random.default_rng(1), 0.0
    env.reset(seed=1)
    for _ in range(steps):
        for agent in (ROBOT, ADVERSARY):
            began = time.process_time()
            mask = env.observe(agent)["action_mask"]
            taken += time.process_time() - began
            answer = int(random.choice(np.flatnonzero(mask)))
            began = time.process_time()
            env.step(answer)
            taken += time.process_time() - began
        if env.core.situation.ending is not None:
            began = time.process_time()
            env.reset()
            taken += time.process_time() - began
    return steps / taken
