"""Answers that are remembered by history against those of a robot that is asked each time."""

from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
from gymnasium.utils.env_checker import data_equivalence

from testbed.learning import AdversaryEnv
from testbed.learning import remembered as module
from testbed.learning.remembered import Remembered, UnlikeError
from testbed.link import InProcessRobot
from testbed.protocol import Capabilities, Decision, Percept, Task, Trace
from tests.environment.coarse import DOMAINS, write_domain

CONFIGS = ("office", *DOMAINS)
GAMES = 12
OPTIONS = {"max_cycles": 10, "goal_feedback": False, "exogenous_while_thinking": True}


def _played(env: AdversaryEnv, seeds: range) -> list[object]:
    """Everything that games of random events return; they begin in few states."""
    random, found = np.random.default_rng(0), list[object]()
    for seed in seeds:
        found.append(env.reset(seed=seed % 3))
        over = False
        while not over:
            event = random.choice(np.flatnonzero(env.action_masks()))
            _, _, *ends, _ = step = env.step(event)
            found.append(step)
            over = any(ends)
    return found


@pytest.mark.parametrize("robot", ["traditional", "intentional", "intentional-checking"])
@pytest.mark.parametrize("name", CONFIGS)
def test_the_games_are_those_of_a_robot_that_is_asked_each_time(
    name: str, robot: str, tmp_path: Path
) -> None:
    config = name if name == "office" else str(write_domain(tmp_path, name))
    one, other = (
        AdversaryEnv(config, robot, remember=remember, **OPTIONS) for remember in (True, False)
    )
    for mine, theirs in zip(_played(one, range(GAMES)), _played(other, range(GAMES)), strict=True):
        assert data_equivalence(mine, theirs)


class Counting:
    """A robot that waits, and counts how often it is asked."""

    capabilities = Capabilities()

    def __init__(self, answers: Callable[[int], str] = lambda _: "wait") -> None:
        self.asked, self.begun, self._answers = 0, 0, answers

    def begin(self, _task: Task) -> None:
        self.begun += 1

    def act(self, percept: Percept) -> Decision:
        self.asked += 1
        return Decision(
            trial=percept.trial,
            step=percept.step,
            action=self._answers(self.asked),  # type: ignore[arg-type]
            believes_goal=False,
            trace=Trace(),
        )


def _task(trial: str) -> Task:
    return Task(
        trial=trial, robot="r", domain="d", source="", goal=[], initial=[], plan_limit=1, seed=0
    )


def _percept(trial: str, step: int, holds: bool | None = None) -> Percept:
    return Percept(
        trial=trial,
        step=step,
        visible=[],
        attempted=None,
        happened=None,
        events=[],
        goal_holds=holds,
    )


def _told(memory: Remembered, trial: str, *holds: bool | None) -> list[str]:
    memory.begin(_task(trial))
    return [str(memory.answer(_percept(trial, n, own))) for n, own in enumerate(holds, start=1)]


def test_a_history_is_told_once_and_again_where_it_goes_on_otherwise() -> None:
    robot = Counting()
    memory = Remembered(InProcessRobot(lambda _: robot))
    _told(memory, "a", None, None, None)
    assert (robot.begun, robot.asked) == (1, 3)
    _told(memory, "b", None, None, None)
    assert (robot.begun, robot.asked) == (1, 3)
    _told(memory, "c", None, None, False, None)  # the first two again, and two that are new
    assert (robot.begun, robot.asked) == (2, 7)
    assert memory.asked == 7


def test_a_robot_that_answers_otherwise_is_refused() -> None:
    robot = Counting(lambda number: "wait" if number < 4 else "finish")
    memory = Remembered(InProcessRobot(lambda _: robot))
    _told(memory, "a", None, None, None)
    with pytest.raises(UnlikeError, match="step 1"):
        _told(memory, "b", None, False)


def test_no_more_is_remembered_than_there_is_room_for(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(module, "MOST", 3)
    robot = Counting()
    memory = Remembered(InProcessRobot(lambda _: robot))
    for trial in "abc":
        _told(memory, trial, None, None, None)
    assert robot.asked == 9


def test_a_robot_by_its_name_is_remembered() -> None:
    env = AdversaryEnv("office", "traditional", remember=True, max_cycles=6)
    for _ in range(3):
        _played(env, range(1))
    before = env.asked
    assert before
    env.reset(seed=0)
    assert env.asked == before
