"""One side of a game as a Gymnasium environment, against trials and PettingZoo's environment."""

import pickle
import subprocess
import sys
from collections.abc import Callable
from copy import deepcopy
from functools import partial
from pathlib import Path
from typing import Any

import gymnasium
import numpy as np
import psutil
import pytest
from gymnasium.utils.env_checker import check_env, data_equivalence
from gymnasium.vector import AsyncVectorEnv

from testbed.config import ConfigError, load_config
from testbed.environment import ADVERSARY, ROBOT, IllegalActionError
from testbed.experiment.plan import plan_trials
from testbed.experiment.robots import make_robot
from testbed.experiment.trial import play_trial
from testbed.learning import AdversaryEnv, RobotEnv
from testbed.link import InProcessRobot
from tests.environment.coarse import DOMAINS, write_domain

CONFIGS = ("office", *DOMAINS)
ROBOTS = ("traditional", "intentional")


@pytest.fixture(params=CONFIGS)
def config(request: pytest.FixtureRequest, tmp_path: Path) -> str:
    name = request.param
    return name if name == "office" else str(write_domain(tmp_path, name))


def _finished(env: Any, seed: int, random: np.random.Generator) -> list[tuple[Any, ...]]:
    """What a game returned at each step, played at random by its masks."""
    found: list[tuple[Any, ...]] = [env.reset(seed=seed)]
    while len(found) < 2 or not any(found[-1][2:4]):
        found.append(env.step(random.choice(np.flatnonzero(env.action_masks()))))
    return found


@pytest.mark.filterwarnings("error")
@pytest.mark.parametrize("form", ["dict", "flat"])
@pytest.mark.parametrize("robot", ROBOTS)
def test_gymnasiums_check_passes_for_the_adversary(config: str, robot: str, form: str) -> None:
    env = AdversaryEnv(config, robot, observations=form, illegal="noop", max_cycles=12)  # type: ignore[arg-type]
    check_env(env, skip_render_check=True)
    env.close()


@pytest.mark.filterwarnings("error")
@pytest.mark.parametrize("form", ["dict", "flat"])
def test_gymnasiums_check_passes_for_the_robot(config: str, form: str) -> None:
    env = RobotEnv(config, observations=form, max_cycles=12)  # type: ignore[arg-type]
    check_env(env, skip_render_check=True)
    env.close()


@pytest.mark.parametrize("robot", ROBOTS)
def test_who_does_nothing_sees_the_robots_trial(config: str, robot: str) -> None:
    """Without an event the robot does what it does in a trial from the same start."""
    read = load_config(config, [f"robots=[{robot}]", "limit=3", "scenarios=none"])
    env = AdversaryEnv(read, robot)
    for spec in plan_trials(read):
        _, info = env.reset(seed=spec.seed, options={"initial": spec.initial})
        done, ended = [], False
        while not ended:
            done.append(env.game.core.robot_actions[info["robot_action"]])
            _, reward, *ends, info = env.step(0)
            ended = any(ends)
        record = play_trial(spec, InProcessRobot(make_robot)).record
        actions = [own for own in done if own not in ("wait", "finish")]
        assert actions == [own.action for own in record.actions]
        assert reward == (-1 if record.achieved else 1)


def test_what_a_side_sees_is_what_its_agent_sees(config: str) -> None:
    random = np.random.default_rng(2)
    for env, agent in ((AdversaryEnv(config, "traditional"), ADVERSARY), (RobotEnv(config), ROBOT)):
        env.reset(seed=3)
        for _ in range(12):
            shown = env.game.observe(agent)
            assert np.array_equal(env.action_masks(), shown["action_mask"].astype(bool))
            seen, reward, *ends, _ = env.step(random.choice(np.flatnonzero(env.action_masks())))
            assert env.observation_space.contains(seen)
            own = env.game.observe(agent)
            assert all(np.array_equal(seen[key], own[key]) for key in own)
            assert reward == env.game.rewards[agent]
            if any(ends):
                break


def test_the_same_seed_plays_the_same_game(config: str) -> None:
    for make in (partial(AdversaryEnv, config, "traditional"), partial(RobotEnv, config)):
        one, other = (_finished(make(max_cycles=9), 5, np.random.default_rng(1)) for _ in range(2))
        assert len(one) == len(other)
        assert all(data_equivalence(a, b) for a, b in zip(one, other, strict=True))


def test_the_adversary_of_the_configuration_plays_inside() -> None:
    script = [{"step": 2, "action": "blow(fern,floor)"}]
    config = {"script": script, "initial": ["stands(fern,bench)", "stands(rose,bench)"]}
    env = RobotEnv(_pots(), **config)
    env.reset(seed=1)
    carry = env.game.core.robot_actions.index("carry(gardener,rose,floor)")
    env.step(carry)
    assert env.game.core.situation.event == "none"
    env.step(env.game.core.robot_actions.index("carry(gardener,rose,sill)"))
    assert env.game.core.situation.event == "blow(fern,floor)"


def _pots() -> str:
    return str(write_domain(Path.cwd(), "pots"))


@pytest.fixture(autouse=True)
def _elsewhere(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)


@pytest.mark.parametrize("kind", ["error", "terminate"])
def test_an_illegal_event_is_what_the_conventions_say(kind: str) -> None:
    env = gymnasium.make("testbed/Adversary-v0", robot="traditional", illegal=kind).unwrapped
    assert isinstance(env, AdversaryEnv)
    env.reset(seed=1)
    illegal = int(np.argmin(env.action_masks()))
    if kind == "error":
        with pytest.raises(IllegalActionError):
            env.step(illegal)
    else:
        _, reward, terminated, *_ = env.step(illegal)
        assert (reward, terminated) == (-1, True)


STRATEGIES: list[dict[str, Any]] = [
    {"strategy": "random", "rate": 0.6, "options": {"burst": 3.0}},
    {"strategy": "meddler"},
    {"strategy": "belief"},
    {"strategy": "greedy"},
]


@pytest.mark.parametrize("copied", [deepcopy, lambda env: pickle.loads(pickle.dumps(env))])
@pytest.mark.parametrize("adversary", STRATEGIES)
def test_a_copy_of_the_robots_side_plays_on_as_the_original(
    config: str, adversary: dict[str, Any], copied: Callable[[Any], Any]
) -> None:
    keys = {"adversary": adversary, "exogenous_while_thinking": True, "max_cycles": 5}
    env, random = RobotEnv(config, **keys), np.random.default_rng(2)
    copies = [copied(env)]
    env.reset(seed=3)
    copies[0].reset(seed=3)
    over = False
    for step in range(8):
        answer = random.choice(np.flatnonzero(env.action_masks()))
        own = env.reset() if over else env.step(answer)
        others = [copy.reset() if over else copy.step(answer) for copy in copies]
        assert all(data_equivalence(other, own) for other in others)
        over = not over and any(own[2:4])
        if step in (1, 4):
            copies.append(copied(env))


def test_a_copy_of_the_adversarys_side_has_another_robot_and_no_game() -> None:
    env = AdversaryEnv("office", "traditional", max_cycles=8)
    env.reset(seed=3)
    copy = pickle.loads(pickle.dumps(env))
    with pytest.raises(IllegalActionError, match="reset"):
        copy.step(0)
    one, other = (_finished(own, 4, np.random.default_rng(1)) for own in (env, copy))
    assert data_equivalence(one, other)


def test_a_copy_of_the_adversarys_side_with_a_table_robot_plays_on(config: str) -> None:
    env, random = AdversaryEnv(config, "cheapest", max_cycles=8), np.random.default_rng(2)
    env.reset(seed=3)
    copy, over = pickle.loads(pickle.dumps(env)), False
    while not over:
        answer = random.choice(np.flatnonzero(env.action_masks()))
        own = env.step(answer)
        assert data_equivalence(copy.step(answer), own)
        over = any(own[2:4])


def _robots(of: psutil.Process) -> list[int]:
    """The processes of robots below a process."""
    return [own.pid for own in of.children(recursive=True) if "robot" in own.cmdline()]


def test_each_worker_of_a_vector_has_a_robot_of_its_own() -> None:
    make = partial(AdversaryEnv, "office", "traditional", link="zenoh", max_cycles=6)
    here = psutil.Process()
    before = set(_robots(here))
    vector = AsyncVectorEnv([make, make], context="spawn")
    try:
        seen, _ = vector.reset(seed=[1, 2])
        assert seen["observation"].shape[0] == 2
        robots = set(_robots(here)) - before
        assert len(robots) == 2
        vector.step(np.array([0, 0]))
    finally:
        vector.close()
    assert not any(psutil.pid_exists(robot) for robot in robots)


@pytest.mark.parametrize(
    "options", [{"config": "levels"}, {"scenario": "nowhere"}, {"goal_feedbak": True}]
)
def test_what_cannot_be_played_is_refused(options: dict[str, Any]) -> None:
    with pytest.raises(ConfigError):
        AdversaryEnv(**options)


def test_gymnasium_imports_what_the_name_says() -> None:
    code = """
import gymnasium
env = gymnasium.make("testbed.learning:testbed/Adversary-v0", robot="cheapest")
env.reset(seed=1)
print(type(env.unwrapped).__name__)
"""
    done = subprocess.run([sys.executable, "-c", code], check=False, capture_output=True, text=True)
    assert (done.stdout, done.stderr) == ("AdversaryEnv\n", "")
