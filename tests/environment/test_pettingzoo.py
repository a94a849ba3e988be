"""The environment against PettingZoo's own tests, and what those do not look at."""

from collections.abc import Callable, Iterator
from functools import partial
from typing import Any

import numpy as np
import pytest
from gymnasium.utils.env_checker import data_equivalence
from pettingzoo import AECEnv, ParallelEnv
from pettingzoo.test import (
    api_test,
    max_cycles_test,
    parallel_api_test,
    parallel_seed_test,
    render_test,
    seed_test,
    state_test,
)
from pettingzoo.utils.conversions import aec_to_parallel

from asp.language import Literal
from testbed import office_v0
from testbed.config import ConfigError
from testbed.environment import ADVERSARY, ROBOT, IllegalActionError
from testbed.world import StateError

pytestmark = pytest.mark.versions

IN_KITCHEN = ["loc(rob1,kitchen)", "in_hand(rob1,book1)", "loc(book2,kitchen)"]
WAIT, FINISH = 0, 1

Episode = list[tuple[Any, ...]]


@pytest.mark.usefixtures("strict")
@pytest.mark.parametrize("make", [office_v0.env, office_v0.raw_env])
def test_api(make: Callable[..., AECEnv]) -> None:
    api_test(make(), num_cycles=300)


@pytest.mark.usefixtures("strict")
def test_parallel_api() -> None:
    parallel_api_test(office_v0.parallel_env(), num_cycles=300)


@pytest.mark.usefixtures("strict")
@pytest.mark.parametrize("make", [office_v0.env, office_v0.raw_env])
def test_seeds(make: Callable[..., AECEnv]) -> None:
    seed_test(make, num_cycles=50)


@pytest.mark.usefixtures("strict")
def test_parallel_seeds() -> None:
    parallel_seed_test(office_v0.parallel_env, num_cycles=50)


@pytest.mark.usefixtures("strict")
def test_the_number_of_cycles_and_the_state() -> None:
    """These tests of PettingZoo answer at random, without looking at masks.

    A game may end before its last cycle, by `finish`: with these seeds none does.
    """

    def drawing(make: Callable[..., Any], **options: Any) -> Any:
        env = make(illegal="noop", **options)
        for seed, agent in enumerate(env.possible_agents):
            env.action_space(agent).seed(seed)
        return env

    class Module:
        env = partial(drawing, office_v0.env)
        parallel_env = partial(drawing, office_v0.parallel_env)

    max_cycles_test(Module)
    state_test(Module.env(), Module.parallel_env(), num_cycles=100)


def test_the_conversion_that_would_show_a_stale_mask_is_refused() -> None:
    with pytest.raises(AssertionError, match="is_parallelizable"):
        aec_to_parallel(office_v0.env())


@pytest.mark.parametrize("make", [office_v0.env, office_v0.raw_env])
def test_render(make: Callable[..., AECEnv], capsys: pytest.CaptureFixture[str]) -> None:
    render_test(make)
    assert "library" in capsys.readouterr().out


def test_parallel_render() -> None:
    env = office_v0.parallel_env(render_mode="rgb_array")
    env.reset(seed=0)
    assert env.render().dtype == np.uint8


def aec_episodes(env: AECEnv, seed: int) -> Iterator[tuple[Any, ...]]:
    """Everything that can be seen in an episode, and at the end of it, playing by the masks."""
    choose = np.random.default_rng(seed)
    env.reset(seed=seed)
    for agent in env.agent_iter():
        observation, *rest = env.last()
        yield (agent, observation, *rest, env.state())
        over = env.terminations[agent] or env.truncations[agent]
        env.step(None if over else sample(observation, choose))


def parallel_episode(env: ParallelEnv, seed: int) -> Iterator[tuple[Any, ...]]:
    choose = np.random.default_rng(seed)
    observations, infos = env.reset(seed=seed)
    yield observations, infos
    while env.agents:
        step = env.step({agent: sample(observations[agent], choose) for agent in env.agents})
        observations = step[0]
        yield (*step, env.state())


def sample(observation: dict[str, np.ndarray], choose: np.random.Generator) -> int:
    return int(choose.choice(np.flatnonzero(observation["action_mask"])))


LOUD = {"observability": {"exo_move": {"mode": "always", "probability": 0.5}}}


@pytest.mark.parametrize(
    ("make", "episode"), [(office_v0.env, aec_episodes), (office_v0.parallel_env, parallel_episode)]
)
def test_whole_episodes_follow_from_the_seed(
    make: Callable[..., Any], episode: Callable[..., Iterator[tuple[Any, ...]]]
) -> None:
    one, other = make(**LOUD), make(**LOUD)
    list(episode(other, 99))  # an episode before must not make a difference
    lengths = []
    for seed in range(20):
        first, second = list(episode(one, seed)), list(episode(other, seed))
        assert len(first) == len(second)
        assert all(data_equivalence(a, b) for a, b in zip(first, second, strict=True))
        lengths.append(len(first))
    assert max(lengths) > 10


def test_other_seeds_give_other_episodes() -> None:
    env = office_v0.env()
    assert len({env.reset(seed=s) or env.state().tobytes() for s in range(20)}) > 10


def test_both_views_play_the_same_game() -> None:
    told = {**LOUD, "infos": "text"}
    aec, parallel = office_v0.env(**told), office_v0.parallel_env(**told)
    for seed in range(20):
        aec.reset(seed=seed)
        parallel.reset(seed=seed)
        choose = np.random.default_rng(seed)
        while parallel.agents:
            robot = sample(aec.observe(ROBOT), choose)
            aec.step(robot)
            event = sample(aec.observe(ADVERSARY), choose)
            aec.step(event)
            seen, rewards, over, cut, infos = parallel.step({ROBOT: robot, ADVERSARY: event})
            assert infos[ADVERSARY]["dropped"] is None
            assert data_equivalence(aec.observe(ROBOT), seen[ROBOT])
            assert aec.infos[ROBOT] == infos[ROBOT]
            assert (aec.rewards, aec.terminations, aec.truncations) == (rewards, over, cut)


def started(make: Callable[..., Any] = office_v0.env, **settings: Any) -> Any:
    env = make(infos="text", **settings)
    env.reset(seed=0, options={"initial": IN_KITCHEN, "trial": "t1"})
    return env


def act(env: AECEnv, robot: str, adversary: str = "none") -> None:
    core = env.unwrapped.core
    env.step(core.robot_actions.index(robot))
    env.step(core.adversary_actions.index(adversary))


def test_what_the_agents_see_is_what_there_is() -> None:
    env = started()
    core = env.unwrapped.core
    vector = env.observe(ROBOT)["observation"]
    named = dict(zip(core.world.fluents, vector, strict=True))
    assert named["loc(book1,kitchen)"] == named["in_hand(rob1,book1)"] == 1
    assert named["loc(rob1,library)"] == named["locked(library)"] == -1
    assert named["loc(book2,office1)"] == 0
    literals = env.infos[ROBOT]["literals"]
    assert len(literals) == np.count_nonzero(vector)
    assert all(named[text.removeprefix("-")] == (-1 if "-" in text else 1) for text in literals)
    assert env.infos[ROBOT]["percept"].trial == "t1"
    assert env.infos[ADVERSARY]["literals"] == list(core.world.literals(core.situation.state))


def test_the_adversary_sees_everything_and_the_robots_choice() -> None:
    env = started()
    core = env.unwrapped.core
    fluents, move = len(core.world.fluents), core.robot_actions.index("move(rob1,library)")
    assert not env.observe(ADVERSARY)["observation"][fluents:].any()
    env.step(move)
    seen = env.observe(ADVERSARY)
    assert np.array_equal(seen["observation"][:fluents], env.state())
    assert np.flatnonzero(seen["observation"][fluents:]).tolist() == [move]
    assert env.infos[ADVERSARY]["robot_action"] == "move(rob1,library)"
    legal = {core.adversary_actions[i] for i in np.flatnonzero(seen["action_mask"])}
    assert legal == set(core.events(Literal.parse("move(rob1,library)")))


@pytest.mark.parametrize("bad", [-1, 11, 99, None, 1.5, "wait", True])
def test_an_answer_that_is_no_action_of_the_robot(bad: object) -> None:
    env = started()
    before = env.snapshot()
    with pytest.raises(IllegalActionError, match=r"robot_0: .* is not an action; .*0 wait, 1 fin"):
        env.step(bad)
    assert data_equivalence(env.snapshot()[1], before[1])
    assert env.unwrapped.core.snapshot() == before[0]
    act(env, "move(rob1,library)")
    assert env.infos[ROBOT]["percept"].happened is True


@pytest.mark.parametrize("make", [office_v0.env, office_v0.raw_env])
def test_an_illegal_answer_of_the_adversary_changes_nothing(make: Callable[..., Any]) -> None:
    env = started(make)
    core = env.unwrapped.core
    env.step(core.robot_actions.index("move(rob1,library)"))
    held = core.adversary_actions.index("exo_move(book1,office1)")
    assert env.observe(ADVERSARY)["action_mask"][held] == 0
    before = core.snapshot()
    message = rf"adversary_0: {held} exo_move\(book1,office1\) .*if in_hand.*legal are 0 none, "
    with pytest.raises(IllegalActionError, match=message):
        env.step(held)
    assert core.snapshot() == before
    assert env.agent_selection == ADVERSARY
    env.step(0)
    assert core.situation.step == 2


def test_parallel_conflicts_are_dropped_and_said() -> None:
    env = started(office_v0.parallel_env)
    robot, adversary = env.core.robot_actions, env.core.adversary_actions
    put_down = robot.index("put_down(rob1,book1)")
    event = "exo_move(book2,library)"
    # The robot thinks: nothing exogenous happens.
    *_, infos = env.step({ROBOT: WAIT, ADVERSARY: adversary.index(event)})
    assert infos[ADVERSARY]["dropped"] == event
    *_, infos = env.step({ROBOT: put_down, ADVERSARY: adversary.index(event)})
    assert infos[ADVERSARY]["dropped"] is None
    assert {"loc(book2,library)", "-in_hand(rob1,book1)"} <= set(infos[ADVERSARY]["literals"])
    # Possible each by itself, contradictory together: the robot's action is what happens.
    pickup, away = robot.index("pickup(rob1,book1)"), "exo_move(book1,office1)"
    *_, infos = env.step({ROBOT: pickup, ADVERSARY: adversary.index(away)})
    assert infos[ADVERSARY]["dropped"] == away
    assert "in_hand(rob1,book1)" in infos[ADVERSARY]["literals"]


@pytest.mark.parametrize("actions", [{}, {ROBOT: 0}, {ROBOT: 0, ADVERSARY: 99}])
def test_a_parallel_step_needs_an_action_of_each(actions: dict[str, int]) -> None:
    env = started(office_v0.parallel_env)
    before = env.snapshot()
    with pytest.raises(IllegalActionError, match="is not an action"):
        env.step(actions)
    assert env.snapshot() == before


@pytest.mark.parametrize(
    ("actions", "reward", "ending"),
    [
        (["move(rob1,library)", "put_down(rob1,book1)", "finish"], 1, "achieved"),
        (["finish", "finish"], -1, "false_finish"),
        (["wait"] * 4, -1, "step_limit"),
    ],
)
def test_rewards_and_endings(actions: list[str], reward: int, ending: str) -> None:
    env = started(goal=["loc(book1,library)", "-in_hand(rob1,book1)"], max_cycles=4)
    for action in actions:
        assert env.rewards == {ROBOT: 0, ADVERSARY: 0}
        act(env, action)
    assert env.rewards == {ROBOT: reward, ADVERSARY: -reward}
    assert env.infos[ROBOT]["outcome"] == env.infos[ADVERSARY]["outcome"] == ending
    assert env.truncations[ROBOT] is (ending == "step_limit")
    assert env.terminations[ROBOT] is (ending != "step_limit")
    for _ in range(2):
        env.step(None)
    assert env.agents == []


def test_a_snapshot_is_taken_in_the_middle_of_a_turn_and_used_twice() -> None:
    env = started(**LOUD)
    env.step(env.unwrapped.core.robot_actions.index("move(rob1,library)"))
    taken = env.snapshot()

    def rest() -> Episode:
        env.restore(taken)
        choose, seen = np.random.default_rng(5), []
        for agent in env.agent_iter():
            observation, *more = env.last()
            seen.append((agent, observation, *more))
            env.step(None if any(more[1:3]) else sample(observation, choose))
        return seen

    assert data_equivalence(rest(), rest())


def test_a_parallel_snapshot_brings_an_ended_game_back() -> None:
    env = started(office_v0.parallel_env, max_cycles=1)
    taken = env.snapshot()
    env.step({ROBOT: WAIT, ADVERSARY: 0})
    ended = env.snapshot()
    assert env.agents == []
    observations, _ = env.restore(taken)
    assert env.agents == [ROBOT, ADVERSARY]
    assert set(observations) == {ROBOT, ADVERSARY}
    env.restore(ended)
    assert env.agents == []


def test_what_a_user_gets_wrong_is_said() -> None:
    with pytest.raises(ConfigError, match=r"^keyword argument: seeed: unknown key; .*'seed'"):
        office_v0.env(seeed=3)
    with pytest.raises(ConfigError, match=r"loc\(book1,attic\)"):
        office_v0.env(goal=["loc(book1,attic)"])
    with pytest.raises(ValueError, match="'ascii' is not a render mode; there are human, ansi"):
        office_v0.env(render_mode="ascii")
    with pytest.raises(StateError, match="cannot be together"):
        office_v0.env().reset(options={"initial": [*IN_KITCHEN, "loc(book2,library)"]})
    env = started(office_v0.parallel_env, max_cycles=1)
    env.step({ROBOT: WAIT, ADVERSARY: 0})
    with pytest.raises(IllegalActionError, match="reset the environment"):
        env.step({ROBOT: WAIT, ADVERSARY: 0})
