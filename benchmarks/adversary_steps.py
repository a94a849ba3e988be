"""A learning adversary against a robot that reasons: steps per second of processor time."""

import time
from collections.abc import Iterator
from itertools import product
from typing import Any

import numpy as np

from benchmarks.sheets import Row, Sheet, gathered
from testbed.learning import AdversaryEnv

ROBOTS = ("traditional", "intentional")
STEPS = {"small": 300, "full": 6_000}
ROUNDS = {"small": 1, "full": 3}
LIMIT = 50
GAMES = (("one", 1), ("one", 2), ("any", 2))
START = ["loc(rob1,kitchen)", "loc(book1,office1)", "loc(book2,office2)"]


def main(size: str) -> list[Sheet]:
    """Sheet `adversary_steps`: a row per robot and round."""
    return [
        Sheet(
            "adversary_steps",
            "Steps of an adversary in the office per second of processor time",
            gathered(_rows(STEPS[size] // ROUNDS[size], ROUNDS[size])),
            (
                "events are drawn among the legal ones, budget: so many per game; games begin in",
                "one state, or in any; in each round first a robot that is asked each time, then",
                "one that is remembered, also from the rounds before; asked: its answers per step",
            ),
        )
    ]


def _rows(steps: int, rounds: int) -> Iterator[Row]:
    for robot, (starts, budget) in product(ROBOTS, GAMES):
        given: dict[str, Any] = {
            "initial": START if starts == "one" else None,
            "adversary": {"budget": budget},
        }
        plain, memory = (
            AdversaryEnv(None, robot, remember=own, max_cycles=LIMIT, **given)
            for own in (False, True)
        )
        asked = 0
        for number in range(1, rounds + 1):
            each, remembered = _rate(plain, steps, number), _rate(memory, steps, number)
            known = memory.asked or 0
            yield {
                "robot": robot,
                "starts": starts,
                "budget": budget,
                "round": number,
                "asked_each_time": each,
                "remembered": remembered,
                "times_faster": remembered / each,
                "asked": (known - asked) / steps,
            }
            asked = known


def _rate(env: AdversaryEnv, steps: int, seed: int) -> float:
    """Steps per second of processor time, resets included."""
    random, over = np.random.default_rng(seed), True
    began = time.process_time()
    for _ in range(steps):
        if over:
            env.reset(seed=int(random.integers(2**31)))
        _, _, *ends, _ = env.step(random.choice(np.flatnonzero(env.action_masks())))
        over = any(ends)
    return steps / (time.process_time() - began)
