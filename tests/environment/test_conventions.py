"""Conventions of environments: infos as numbers, illegal answers, spaces of one shape."""

from pathlib import Path
from typing import Any

import numpy as np
import pytest
from pettingzoo.test import api_test, parallel_api_test
from pettingzoo.utils.wrappers import TerminateIllegalWrapper

from testbed import office_v0
from testbed.config import ConfigError
from testbed.environment import ADVERSARY, ROBOT, Ending, IllegalActionError
from tests.environment.coarse import DOMAINS, write_domain

CONFIGS = ("office", *DOMAINS)
MAKERS = (office_v0.env, office_v0.parallel_env)
pytestmark = pytest.mark.versions


@pytest.fixture(params=CONFIGS)
def config(request: pytest.FixtureRequest, tmp_path: Path) -> str:
    name = request.param
    return name if name == "office" else str(write_domain(tmp_path, name))


def _drawn(mask: np.ndarray, random: np.random.Generator) -> int:
    return int(random.choice(np.flatnonzero(mask)))


def _numbers(value: Any) -> bool:
    return isinstance(value, int | float) or (
        isinstance(value, np.ndarray) and value.dtype.kind in "if"
    )


def test_infos_are_numbers_with_the_same_keys_at_each_step(config: str) -> None:
    env, random = office_v0.parallel_env(config, max_cycles=6), np.random.default_rng(2)
    for seed in range(4):
        shown, infos = env.reset(seed=seed)
        keys = {agent: own.keys() for agent, own in infos.items()}
        while env.agents:
            answers = {agent: _drawn(own["action_mask"], random) for agent, own in shown.items()}
            shown, *_, infos = env.step(answers)
            assert {agent: own.keys() for agent, own in infos.items()} == keys
            assert all(_numbers(value) for own in infos.values() for value in own.values())


def test_numbers_say_what_the_text_says(config: str) -> None:
    both = [office_v0.env(config, max_cycles=9, infos=kind) for kind in ("numeric", "text")]
    random = np.random.default_rng(3)
    for seed in range(6):
        for env in both:
            env.reset(seed=seed)
        while not any(both[0].terminations.values()) and not any(both[0].truncations.values()):
            agent = both[0].agent_selection
            answer = _drawn(both[0].observe(agent)["action_mask"], random)
            for env in both:
                env.step(answer)
            _say_the_same(*both)


def _say_the_same(numeric: Any, text: Any) -> None:
    core = text.unwrapped.core
    for agent in (ROBOT, ADVERSARY):
        own, other = numeric.infos[agent], text.infos[agent]
        assert (None, *Ending)[own["outcome"]] == other["outcome"]
        named = dict(zip(core.world.fluents, own["goal"], strict=True))
        goal = {atom if sign > 0 else atom.complement for atom, sign in named.items() if sign}
        assert goal == set(other["goal"])
    percept = text.infos[ROBOT]["percept"]
    robot, adversary = numeric.infos[ROBOT], numeric.infos[ADVERSARY]
    assert robot["step"] == adversary["step"] == percept.step
    assert {1: True, 0: None, -1: False}[robot["happened"]] is percept.happened
    assert {0: None, -1: False}[robot["goal_holds"]] is percept.goal_holds
    chosen = text.infos[ADVERSARY]["robot_action"]
    number = adversary["robot_action"]
    assert (core.robot_actions[number] if number >= 0 else None) == chosen


def test_a_dropped_event_is_told_by_its_number() -> None:
    env = office_v0.parallel_env()
    env.reset(seed=0)
    (*_, infos) = env.step({ROBOT: 0, ADVERSARY: 1})  # nothing exogenous while the robot waits
    assert infos[ADVERSARY]["dropped"] == 1
    (*_, infos) = env.step({ROBOT: 0, ADVERSARY: 0})
    assert infos[ADVERSARY]["dropped"] == -1


def _illegal(env: Any) -> int:
    """Begin, let the robot wait; an illegal answer of the adversary."""
    env.reset(seed=0)
    env.step(0)
    return int(np.argmin(env.observe(ADVERSARY)["action_mask"]))


def test_an_illegal_answer_does_nothing(config: str) -> None:
    env, other = (office_v0.env(config, illegal=kind) for kind in ("noop", "error"))
    illegal = _illegal(env)
    _illegal(other)
    env.step(illegal)
    other.step(0)
    assert env.infos[ADVERSARY]["illegal"] == 1
    assert np.array_equal(env.state(), other.state())
    assert env.unwrapped.core.situation == other.unwrapped.core.situation
    assert env.rewards == other.rewards


def _answers(space: Any, mask: np.ndarray, random: np.random.Generator) -> tuple[int, bool]:
    """An answer, legal or not, and whether it is not."""
    answer = int(random.integers(space.n))
    return answer, not mask[answer]


@pytest.mark.parametrize("kind", ["noop", "terminate"])
@pytest.mark.parametrize("infos", ["numeric", "text"])
def test_an_agent_is_told_that_its_last_answer_was_illegal_until_it_answers_again(
    kind: str, infos: str, config: str
) -> None:
    for padded in (True, False):
        env = office_v0.env(config, illegal=kind, infos=infos, padded=padded, max_cycles=9)
        random = np.random.default_rng(6)
        for seed in range(3):
            env.reset(seed=seed)
            last = dict.fromkeys(env.agents, False)
            for agent in env.agent_iter():
                seen, _, terminated, truncated, info = env.last()
                assert {own: env.infos[own]["illegal"] for own in env.agents} == last
                assert info["illegal"] == last[agent]
                if terminated or truncated:
                    env.step(None)
                    del last[agent]
                    continue
                mask = seen["action_mask"]
                answer, last[agent] = _answers(env.action_space(agent), mask, random)
                env.step(answer)


@pytest.mark.parametrize("kind", ["noop", "terminate"])
def test_in_parallel_both_are_told_of_their_last_answer(kind: str, config: str) -> None:
    env = office_v0.parallel_env(config, illegal=kind, padded=True, max_cycles=9)
    random = np.random.default_rng(7)
    for seed in range(3):
        shown, infos = env.reset(seed=seed)
        assert {own["illegal"] for own in infos.values()} == {0}
        while env.agents:
            both = {
                agent: _answers(env.action_space(agent), own["action_mask"], random)
                for agent, own in shown.items()
            }
            shown, *_, infos = env.step({agent: answer for agent, (answer, _) in both.items()})
            told = {agent: bool(own["illegal"]) for agent, own in infos.items()}
            assert told == {agent: illegal for agent, (_, illegal) in both.items()}


def test_a_copy_tells_of_the_last_answer_too() -> None:
    env = office_v0.raw_env(illegal="noop")
    env.step(_illegal(env))
    saved = env.snapshot()
    env.step(0)
    env.step(0)
    assert env.infos[ADVERSARY]["illegal"] == 0
    env.restore(saved)
    assert env.infos[ADVERSARY]["illegal"] == 1


def test_an_illegal_answer_ends_the_game_as_pettingzoos_wrapper_does(config: str) -> None:
    env = office_v0.env(config, illegal="terminate")
    wrapped = TerminateIllegalWrapper(office_v0.env(config), illegal_reward=-1)
    for own in (env, wrapped):
        own.step(_illegal(own))
    for _ in range(2):
        assert env.agent_selection == wrapped.agent_selection
        assert env.agents == wrapped.agents
        for name in ("terminations", "truncations", "rewards", "_cumulative_rewards"):
            assert getattr(env.unwrapped, name) == getattr(wrapped.unwrapped, name)
        (_, *mine), (_, *theirs) = env.last(), wrapped.last()
        assert mine[:3] == theirs[:3]
        env.step(None)
        wrapped.step(None)
    assert env.agents == wrapped.agents == []
    env.reset(seed=1)
    assert env.agents == [ROBOT, ADVERSARY]


def test_after_an_illegal_answer_masks_hold_action_0_alone(config: str) -> None:
    env = office_v0.env(config, illegal="terminate")
    env.step(_illegal(env))
    for agent in (ROBOT, ADVERSARY):
        mask = env.observe(agent)["action_mask"]
        assert np.flatnonzero(mask).tolist() == [0]


@pytest.mark.parametrize("kind", ["noop", "terminate"])
@pytest.mark.parametrize("answer", [-1, 1.5, 10**6, None, "wait"])
def test_what_is_no_answer_at_all_is_an_error_under_all_conventions(
    kind: str, answer: object
) -> None:
    env = office_v0.env(illegal=kind)
    env.reset(seed=0)
    with pytest.raises(IllegalActionError):
        env.step(answer)
    parallel = office_v0.parallel_env(illegal=kind)
    parallel.reset(seed=0)
    with pytest.raises(IllegalActionError):
        parallel.step({ROBOT: 0, ADVERSARY: answer})


def test_in_parallel_an_event_outside_the_mask_is_illegal_and_a_conflict_is_dropped() -> None:
    env = office_v0.parallel_env(illegal="terminate")
    shown, _ = env.reset(seed=0)
    mask = shown[ADVERSARY]["action_mask"]
    legal = int(np.flatnonzero(mask)[-1])
    _, rewards, ended, _, infos = env.step({ROBOT: 0, ADVERSARY: legal})
    assert infos[ADVERSARY]["dropped"] == legal  # beside `wait`
    assert not any(ended.values())
    outside = int(np.argmin(mask))
    shown, rewards, ended, cut, _ = env.step({ROBOT: 0, ADVERSARY: outside})
    assert rewards == {ROBOT: 0, ADVERSARY: -1}
    assert all(ended.values())
    assert all(cut.values())
    assert env.agents == []
    assert {int(own["action_mask"].sum()) for own in shown.values()} == {1}


def test_padded_spaces_are_equal_and_hold_the_same_in_front(config: str) -> None:
    plain, wide = office_v0.env(config), office_v0.env(config, padded=True)
    assert wide.observation_space(ROBOT) == wide.observation_space(ADVERSARY)
    assert wide.action_space(ROBOT) == wide.action_space(ADVERSARY)
    random = np.random.default_rng(4)
    for env in (plain, wide):
        env.reset(seed=1)
    for _ in range(20):
        agent = plain.agent_selection
        own, padded = plain.observe(agent), wide.observe(agent)
        assert wide.observation_space(agent).contains(padded)
        for name, part in own.items():
            assert np.array_equal(padded[name][: len(part)], part)
            assert not padded[name][len(part) :].any()
        over = plain.terminations[agent] or plain.truncations[agent]
        if over:
            break
        answer = _drawn(own["action_mask"], random)
        plain.step(answer)
        wide.step(answer)


@pytest.mark.parametrize(("kind", "ended"), [("error", None), ("noop", False), ("terminate", True)])
def test_an_action_that_only_pads_is_illegal(kind: str, ended: bool | None) -> None:
    env = office_v0.env(padded=True, illegal=kind)
    env.reset(seed=0)
    env.step(0)
    last = int(env.action_space(ADVERSARY).n) - 1
    assert last >= len(env.unwrapped.core.adversary_actions)
    if ended is None:
        with pytest.raises(IllegalActionError):
            env.step(last)
    else:
        env.step(last)
        assert any(env.terminations.values()) is ended


@pytest.mark.usefixtures("strict")
@pytest.mark.parametrize("kind", ["error", "noop", "terminate"])
@pytest.mark.parametrize("padded", [True, False])
@pytest.mark.parametrize("infos", ["numeric", "text"])
def test_pettingzoos_tests_pass_under_all_conventions(
    kind: str, padded: bool, infos: str, config: str
) -> None:
    options = {"illegal": kind, "padded": padded, "infos": infos}
    api_test(office_v0.env(config, **options), num_cycles=60)
    parallel_api_test(office_v0.parallel_env(config, **options), num_cycles=60)


@pytest.mark.parametrize("key", ["infos", "illegal"])
def test_a_convention_that_there_is_not_is_refused(key: str) -> None:
    with pytest.raises(ConfigError, match=key):
        office_v0.env(**{key: "other"})
