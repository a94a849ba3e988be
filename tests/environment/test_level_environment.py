"""The PettingZoo environment at the fine resolution."""

import warnings
from typing import Any

import numpy as np
import pytest
from gymnasium.utils.env_checker import data_equivalence
from pettingzoo.test import api_test, parallel_api_test

from testbed import office_v0
from testbed.config import ConfigError
from testbed.environment import ADVERSARY, ROBOT, IllegalActionError


@pytest.fixture
def untested(strict: None) -> None:
    """A robot that has not tested anything knows nothing."""
    del strict
    warnings.filterwarnings("ignore", "Observation numpy array is all zeros")


@pytest.mark.usefixtures("untested")
@pytest.mark.parametrize(("level", "cycles"), [("L1", 200), ("L2", 60), ("L3", 20)])
def test_api(level: str, cycles: int) -> None:
    api_test(office_v0.env(level=level), num_cycles=cycles)
    parallel_api_test(office_v0.parallel_env(level=level), num_cycles=cycles)


def sample(env: Any, choose: np.random.Generator) -> int:
    mask = env.observe(env.agent_selection)["action_mask"]
    return int(choose.choice(np.flatnonzero(mask)))


def test_the_mask_is_what_the_world_allows() -> None:
    env = office_v0.raw_env(level="L2", max_cycles=40)
    choose = np.random.default_rng(5)
    env.reset(seed=5)
    refused = 0
    for _ in range(30):
        env.step(int(choose.integers(2, len(env.core.robot_actions))))
        mask = env.observe(ADVERSARY)["action_mask"]
        assert mask.shape == (len(env.core.adversary_actions),)
        before = env.core.snapshot()
        if not mask.all():
            with pytest.raises(IllegalActionError):
                env.step(int(choose.choice(np.flatnonzero(mask == 0))))
            assert env.core.snapshot() == before
            refused += 1
        env.step(int(choose.choice(np.flatnonzero(mask))))
    assert refused > 10


def test_the_robot_observes_what_a_test_shows_and_nothing_else() -> None:
    env = office_v0.raw_env(level="L1", statistics={}, initial=None, infos="text")
    start = ["fine_loc(rob1,room1_1)", "fine_loc(object1_1,room1_1)"]
    env.reset(seed=0, options={"initial": start})
    fluents, actions = env.core.world.fluents, env.core.robot_actions
    assert not env.observe(ROBOT)["observation"].any()
    env.step(actions.index("test_fine_loc(rob1,object1_1,room1_1)"))
    env.step(0)
    seen = env.observe(ROBOT)["observation"]
    assert {fluents[i]: int(seen[i]) for i in np.flatnonzero(seen)} == {
        "fine_loc(object1_1,room1_1)": 1
    }
    assert env.infos[ROBOT]["percept"].happened is True
    everything = env.observe(ADVERSARY)["observation"][: len(fluents)]
    assert np.abs(everything).all()


def test_each_game_has_a_goal_of_its_own_that_does_not_hold_yet() -> None:
    env = office_v0.raw_env(level="L2", infos="text")
    goals = []
    for seed in range(12):
        env.reset(seed=seed)
        goals.append(env.infos[ROBOT]["goal"])
        assert not env.core.achieved
        env.step(0)
        env.step(0)
        assert env.infos[ROBOT]["goal"] == goals[-1] == list(env.core.situation.goal)
    assert len({tuple(goal) for goal in goals}) > 3
    given = office_v0.raw_env(level="L2", goal=["loc(object1,room3)"], infos="text")
    given.reset(seed=1)
    assert given.infos[ADVERSARY]["goal"] == ["loc(object1,room3)"]


def test_a_goal_belongs_to_its_moment() -> None:
    env = office_v0.raw_env(level="L1", infos="text")
    env.reset(seed=1)
    moment, goal = env.snapshot(), env.infos[ROBOT]["goal"]
    others = []
    for seed in range(2, 12):
        env.reset(seed=seed)
        others.append(env.infos[ROBOT]["goal"])
    assert any(other != goal for other in others)
    env.restore(moment)
    assert list(env.core.situation.goal) == goal == env.infos[ROBOT]["goal"]


def test_whole_episodes_follow_from_the_seed() -> None:
    def episode(env: Any, seed: int) -> list[Any]:
        choose = np.random.default_rng(seed)
        env.reset(seed=seed)
        seen = []
        for _ in range(60):
            if env.terminations[env.agent_selection] or env.truncations[env.agent_selection]:
                break
            env.step(sample(env, choose))
            seen.append((env.observe(ROBOT), env.rewards.copy(), env.state()))
        return seen

    one, other = office_v0.raw_env(level="L2"), office_v0.raw_env(level="L2")
    for seed in range(5):
        first, second = episode(one, seed), episode(other, seed)
        assert len(first) == len(second)
        assert all(data_equivalence(a, b) for a, b in zip(first, second, strict=True))


def test_several_levels_ask_for_one() -> None:
    with pytest.raises(ConfigError, match="there are several levels; give one, as in level='L1'"):
        office_v0.raw_env("levels")
    with pytest.raises(ConfigError, match="L9"):
        office_v0.raw_env(level="L9")
