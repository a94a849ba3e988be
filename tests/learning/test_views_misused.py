"""The sides of a game after errors inside, and what is wrong with their parameters."""

import re
from functools import partial
from typing import Any

import numpy as np
import pytest
from gymnasium.utils.env_checker import data_equivalence
from gymnasium.vector import AutoresetMode

from testbed import office_v0
from testbed.config import ConfigError
from testbed.environment import ADVERSARY, IllegalActionError
from testbed.learning import AdversaryEnv, Batch, RobotEnv
from testbed.protocol import RobotLost

PAID: dict[str, Any] = {
    "adversary": {"cost": 0.1},
    "rewards": {"step": 0.25, "shaping": 0.5},
    "exogenous_while_thinking": True,
}


@pytest.mark.parametrize("robot", ["traditional", "intentional"])
def test_the_adversary_gets_what_every_step_is_worth(robot: str) -> None:
    env, draw = AdversaryEnv("office", robot, max_cycles=12, **PAID), np.random.default_rng(1)
    for seed in range(3):
        env.reset(seed=seed)
        over = False
        while not over:
            core, legal = env.game.core, np.flatnonzero(env.action_masks())
            choice = int(legal[draw.integers(len(legal))])
            _, reward, ended, cut, _ = env.step(choice)
            over = ended or cut
            assert reward == pytest.approx(core.rewards[ADVERSARY])


def test_after_an_error_inside_the_game_has_to_begin_anew(monkeypatch: pytest.MonkeyPatch) -> None:
    env = AdversaryEnv("office", "traditional")
    env.reset(seed=1)

    def lost() -> None:
        raise RobotLost("gone")

    with monkeypatch.context() as patch:
        patch.setattr(env, "_let_robot_answer", lost)
        with pytest.raises(RobotLost):
            env.step(0)
    before = env.game.core.situation
    with pytest.raises(IllegalActionError, match="reset"):
        env.step(2)
    assert env.game.core.situation is before
    env.reset(seed=1)
    env.step(0)


def test_an_event_that_is_impossible_is_the_inner_adversarys_error() -> None:
    script = [{"step": 1, "action": "exo_lock(library)"}]
    env = RobotEnv("office", script=script, exogenous_while_thinking=False)
    env.reset(seed=1)
    with pytest.raises(Exception, match="exo_lock"):
        env.step(0)
    with pytest.raises(IllegalActionError, match="reset"):
        env.step(2)


@pytest.mark.parametrize("illegal", ["error", "noop"])
@pytest.mark.parametrize("bad", [-1, 99, None, 0.9, "0", [0], np.array([0]), True])
def test_an_answer_that_is_no_action_of_a_side(bad: object, illegal: str) -> None:
    """As in the environment of both agents, whose action spaces take True for an integer."""
    for env in (AdversaryEnv("office", "cheapest", illegal=illegal), RobotEnv("office")):
        env.reset(seed=1)
        before = env.game.snapshot()
        tolerated = bad is True and env.game.conventions.illegal == "noop"
        if tolerated:
            env.step(bad)  # type: ignore[arg-type]
            assert env.game.core.situation.event == "none"
            continue
        with pytest.raises(IllegalActionError, match=r"_0: .* is not an action; there are 0 "):
            env.step(bad)  # type: ignore[arg-type]
        assert env.game.core.snapshot() == before[0]
        assert data_equivalence(env.game.snapshot()[1], before[1])
        env.step(0)


@pytest.mark.parametrize("make", [partial(AdversaryEnv, robot="cheapest"), RobotEnv])
def test_an_integer_of_any_type_is_an_action(make: Any) -> None:
    for answer in (0, np.int8(0), np.uint64(0), np.array(0)):
        env = make("office")
        env.reset(seed=1)
        env.step(answer)
        assert env.game.core.situation.step == 2


def test_after_the_end_nothing_is_played() -> None:
    env = AdversaryEnv("office", "traditional", max_cycles=1)
    env.reset(seed=1)
    env.step(0)
    with pytest.raises(IllegalActionError, match="reset"):
        env.step(0)


@pytest.mark.parametrize(
    ("make", "part"),
    [
        (lambda: AdversaryEnv("office", observations="flatt"), "observations"),  # type: ignore[arg-type]
        (lambda: AdversaryEnv("office", link="zenho"), "link"),  # type: ignore[arg-type]
        *((lambda n=n: office_v0.raw_env(max_cycles=n), "max_cycles") for n in (0, -5, 2.5, True)),
        (lambda: RobotEnv("office", max_cycles="ten"), "max_cycles"),  # type: ignore[arg-type]
        *((lambda n=n: Batch("office", games=n), "games") for n in (0, -1, 2.0, True)),
    ],
)
def test_a_wrong_parameter_is_said_when_it_is_given(make: Any, part: str) -> None:
    with pytest.raises(ConfigError, match=part):
        make()


@pytest.mark.parametrize("robot", ["nobody", "os:path", "human", 5])
@pytest.mark.parametrize("link", ["inprocess", "zenoh"])
def test_a_robot_that_cannot_play_is_refused_when_it_is_named(link: Any, robot: Any) -> None:
    with pytest.raises(ConfigError, match="robot"):
        AdversaryEnv("office", robot, link=link)


@pytest.mark.parametrize(
    ("adversary", "key"),
    [
        ({"strategy": "rndom"}, "adversary.strategy"),
        ({"strategy": "human"}, "adversary.strategy"),
        ({"strategy": "random", "options": {"bursd": 2}}, "adversary.options.bursd"),
        ({"strategy": "optimal"}, "adversary.budget"),
        ({"strategy": "optimal", "budget": 1}, "rehearse"),
        ({"strategy": "learned", "options": {"policy": "nowhere"}}, "nowhere"),
    ],
)
def test_an_adversary_that_cannot_play_is_refused_when_it_is_named(
    adversary: dict[str, Any], key: str
) -> None:
    with pytest.raises(ConfigError, match=re.escape(key)):
        RobotEnv("office", adversary=adversary)


def test_a_batch_takes_masks_and_modes_alone() -> None:
    batch = Batch("office", games=4, autoreset_mode="SameStep", seed=1)  # type: ignore[arg-type]
    assert batch.autoreset_mode is AutoresetMode.SAME_STEP
    with pytest.raises(ValueError, match="same_step"):
        Batch("office", games=4, autoreset_mode="same_step")  # type: ignore[arg-type]
    for wrong in (np.array([3]), [True], np.ones(5, np.bool_)):
        with pytest.raises(IllegalActionError, match="begin"):
            batch.begin(wrong)


def test_a_refused_reset_changes_nothing() -> None:
    env = office_v0.raw_env()
    env.reset(seed=3)
    before = env.core.situation, env.core.random_state
    with pytest.raises(Exception, match="nowhere"):
        env.reset(seed=7, options={"initial": ["loc(rob1,nowhere)"]})
    assert (env.core.situation, env.core.random_state) == before


def test_a_parallel_game_goes_back_from_an_illegal_end() -> None:
    env = office_v0.parallel_env(illegal="terminate")
    seen, _ = env.reset(seed=1)
    saved = env.snapshot()
    outside = int(np.flatnonzero(seen[ADVERSARY]["action_mask"] == 0)[0])
    env.step({"robot_0": 0, ADVERSARY: outside})
    over = env.snapshot()
    again, _ = env.restore(saved)
    assert np.array_equal(again["robot_0"]["action_mask"], seen["robot_0"]["action_mask"])
    env.restore(over)
    assert env.agents == []


def test_less_than_nothing_is_nothing_left() -> None:
    first = office_v0.raw_env(exogenous_while_thinking=True).core
    first.reset(seed=1)
    for _ in range(2):
        first.advance(first.robot_actions[0], first.events(first.robot_actions[0])[1])
    bounded = office_v0.raw_env(exogenous_while_thinking=True, adversary={"budget": 1}).core
    bounded.reset(seed=1)
    bounded.restore(first.snapshot())
    assert bounded.left.budget == 0
    assert bounded.events(bounded.robot_actions[0]) == ("none",)
