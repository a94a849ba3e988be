"""SuperSuit's vector environments of the parallel environment with equal spaces."""

from pathlib import Path

import numpy as np
import pytest
import supersuit

from testbed import office_v0
from testbed.environment import ADVERSARY, ROBOT
from tests.environment.coarse import DOMAINS, write_domain


def _picked(masks: np.ndarray, random: np.random.Generator) -> np.ndarray:
    return np.array([random.choice(np.flatnonzero(mask)) for mask in masks])


@pytest.mark.parametrize("name", ["office", *DOMAINS])
def test_a_vector_of_both_agents_is_the_parallel_environment(name: str, tmp_path: Path) -> None:
    config = "office" if name == "office" else str(write_domain(tmp_path, name))
    options = {"padded": True, "illegal": "noop", "max_cycles": 8}
    single = office_v0.parallel_env(config, **options)
    vector = supersuit.pettingzoo_env_to_vec_env_v1(office_v0.parallel_env(config, **options))
    random = np.random.default_rng(1)
    seen, _ = vector.reset(seed=3)
    shown, _ = single.reset(seed=3)
    for _ in range(8):
        for number, agent in enumerate((ROBOT, ADVERSARY)):
            assert np.array_equal(seen["observation"][number], shown[agent]["observation"])
            assert np.array_equal(seen["action_mask"][number], shown[agent]["action_mask"])
        robot, event = _picked(seen["action_mask"], random)
        seen, rewards, ended, cut, _ = vector.step(np.array([robot, event]))
        shown, *told, _ = single.step({ROBOT: int(robot), ADVERSARY: int(event)})
        for own, other in zip((rewards, ended, cut), told, strict=True):
            assert list(own) == [other[agent] for agent in (ROBOT, ADVERSARY)]
        if not single.agents:
            break


def test_several_of_them_are_played_together() -> None:
    env = office_v0.parallel_env(padded=True, illegal="noop", max_cycles=5)
    vector = supersuit.pettingzoo_env_to_vec_env_v1(env)
    games = supersuit.concat_vec_envs_v1(vector, 3, num_cpus=0, base_class="gymnasium")
    random, ends = np.random.default_rng(1), 0
    seen, _ = games.reset(seed=1)
    for _ in range(20):
        seen, _, ended, cut, _ = games.step(_picked(seen["action_mask"], random))
        ends += int(np.sum(ended | cut))
    assert ends
