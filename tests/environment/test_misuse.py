"""What is asked of an environment at the wrong time, of the wrong agent, or in the wrong form."""

import json
import pickle
import re
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from gymnasium.utils.env_checker import data_equivalence

from testbed import office_v0
from testbed.config import ConfigError, conditions_of, load_config
from testbed.environment import (
    ADVERSARY,
    ROBOT,
    IllegalActionError,
    NotResetError,
    ResetOptionError,
    UnknownAgentError,
    UnknownOptionError,
)
from testbed.learning import RobotEnv
from testbed.world import StateError

MAKERS = [office_v0.env, office_v0.raw_env, office_v0.parallel_env]
UNWRAPPED = [office_v0.raw_env, office_v0.parallel_env]
GARDEN = """
sorts
  bed   = {north, south}.
  robot = {ida}.
fluents
  inertial watered(bed).
actions
  agent     water(robot, bed).
  exogenous dry_out(bed).
laws
  water(R, B) causes watered(B).
  dry_out(B) causes -watered(B).
  impossible dry_out(B) if -watered(B).
sees
  R sees watered(B) if robot(R).
scenarios
  quiet: nothing.
"""


@pytest.fixture
def garden(tmp_path: Path) -> dict[str, Any]:
    """Keyword arguments for a domain that shares no word with the office."""
    path = tmp_path / "garden.al"
    path.write_text(GARDEN, encoding="utf-8")
    goal = ["watered(north)", "watered(south)"]
    return {"domain": str(path), "goal": goal, "scenarios": ["quiet"], "observability": {}}


def _step(env: Any, robot: int, adversary: int = 0) -> None:
    if hasattr(env, "agent_selection"):
        env.step(robot)
        env.step(adversary)
    else:
        env.step({ROBOT: robot, ADVERSARY: adversary})


def _seen(env: Any, agent: str) -> dict[str, np.ndarray]:
    if hasattr(env, "observe"):
        seen: dict[str, np.ndarray] = env.observe(agent)
        return seen
    return env.restore(env.snapshot())[0][agent]  # type: ignore[no-any-return]


def test_each_exogenous_action_is_tested_once_for_a_mask(garden: dict[str, Any]) -> None:
    env = office_v0.raw_env(**garden, infos="text")
    core, asked = env.core, list[str]()
    world, executable = core.world, core.world.executable
    world.executable = lambda state, names: asked.extend(names) or executable(state, names)  # type: ignore
    env.reset(seed=0, options={"initial": ["watered(north)"]})
    env.step(core.robot_actions.index("water(ida,south)"))
    asked.clear()
    mask = env.observe(ADVERSARY)["action_mask"]
    assert [name for name in asked if name in world.exogenous_actions] == list(
        world.exogenous_actions
    )
    beside = dict(zip(core.adversary_actions, mask, strict=True))
    assert beside == {"none": 1, "dry_out(north)": 1, "dry_out(south)": 0}


@pytest.mark.parametrize("level", [None, "L1"])
@pytest.mark.parametrize("make", MAKERS)
def test_a_pickled_environment_plays_on_as_the_original(
    make: Callable[..., Any], level: str | None
) -> None:
    env = make(level=level)
    env.reset(seed=3)
    _step(env, 2)
    copy = pickle.loads(pickle.dumps(env))
    for action in (3, 2, 0, 4):
        for one in (env, copy):
            _step(one, action)
        assert data_equivalence(env.state(), copy.state())
        assert data_equivalence(_seen(env, ROBOT), _seen(copy, ROBOT))
    env.reset()
    copy.reset()
    assert data_equivalence(env.state(), copy.state()), "what is drawn next is the same"


@pytest.mark.parametrize("answer", [np.int64(1), np.int8(1), np.array(1)])
def test_an_integer_of_any_type_is_an_answer(answer: Any) -> None:
    env = office_v0.raw_env(max_cycles=5)
    env.reset(seed=0)
    _step(env, answer, answer * 0)
    assert env.core.situation.answer == "finish"


@pytest.mark.parametrize("answer", [np.array([0]), np.array([0, 1]), np.float64(1), np.bool_(True)])
@pytest.mark.parametrize("make", MAKERS)
def test_an_array_and_a_number_that_counts_nothing_are_none(
    make: Callable[..., Any], answer: Any
) -> None:
    env = make()
    env.reset(seed=0)
    with pytest.raises(IllegalActionError, match=r"robot_0: .* is not an action; .*0 wait"):
        _step(env, answer)


@pytest.mark.parametrize("make", UNWRAPPED)
@pytest.mark.parametrize("mode", [None, "ansi", "rgb_array"])
def test_before_reset_there_is_no_game(make: Callable[..., Any], mode: str | None) -> None:
    env = make(render_mode=mode)
    for ask in (env.state, env.render, env.snapshot, lambda: env.step({ROBOT: 0, ADVERSARY: 0})):
        with pytest.raises(NotResetError, match="reset"):
            ask()


@pytest.mark.parametrize("ask", ["observe", "last"])
def test_before_reset_nobody_sees_anything(ask: str) -> None:
    env = office_v0.raw_env()
    with pytest.raises(NotResetError, match="reset"):
        env.observe(ROBOT) if ask == "observe" else env.last()


@pytest.mark.parametrize("ask", ["state", "render"])
def test_before_reset_the_wrapper_raises_the_same_kind(ask: str) -> None:
    assert issubclass(NotResetError, AssertionError)
    with pytest.raises(AssertionError, match="reset"):
        getattr(office_v0.env(), ask)()


@pytest.mark.parametrize("ask", ["observe", "observation_space", "action_space"])
def test_an_unknown_agent_is_told_the_known_ones(ask: str) -> None:
    env = office_v0.env()
    env.reset(seed=0)
    with pytest.raises(UnknownAgentError, match=r"'nobody'.*robot_0.*adversary_0"):
        getattr(env, ask)("nobody")


@pytest.mark.parametrize(
    ("given", "plain"),
    [
        ({"goal_feedback": np.bool_(False)}, {"goal_feedback": False}),
        ({"seed": np.int64(3)}, {"seed": 3}),
        ({"rewards": {"step": np.float32(0.5)}}, {"rewards": {"step": 0.5}}),
        ({"adversary.budget": np.uint8(2)}, {"adversary.budget": 2}),
        ({"initial": np.array(["watered(south)"])}, {"initial": ["watered(south)"]}),
    ],
)
def test_values_of_numpy_are_those_of_python(
    given: dict[str, Any], plain: dict[str, Any], garden: dict[str, Any]
) -> None:
    one, other = (office_v0.read_config(**garden, **own) for own in (given, plain))
    assert one == other
    assert one.model_dump_json() == other.model_dump_json()


def test_a_path_is_its_text(garden: dict[str, Any]) -> None:
    path = Path(garden["domain"])
    assert office_v0.read_config(**{**garden, "domain": path}).domain == str(path)


@pytest.mark.parametrize("value", [object(), {"watered(south)"}, [np.datetime64(1, "s")], 3j])
def test_what_no_configuration_can_have_is_refused(value: object, garden: dict[str, Any]) -> None:
    with pytest.raises(ConfigError, match=r"^keyword argument: initial: "):
        office_v0.env(**garden, initial=value)


@pytest.mark.parametrize("make", MAKERS)
def test_an_unknown_option_of_reset_is_told_what_was_meant(make: Callable[..., Any]) -> None:
    env = make()
    with pytest.raises(UnknownOptionError, match=r"'intial'.*'initial'"):
        env.reset(seed=0, options={"intial": []})
    env.reset(seed=0, options={"options": 1})  # as PettingZoo's own tests do


@pytest.mark.parametrize("make", [*MAKERS, RobotEnv])
@pytest.mark.parametrize(
    "options",
    [
        "initial",
        ["initial"],
        5,
        {5: 3},
        {"initial": "watered(north)"},
        {"initial": {"watered(north)": True}},
        {"initial": 5},
        {"trial": 5},
        {"trial": None},
    ],
)
def test_options_of_another_type_are_refused_and_nothing_has_changed(
    make: Callable[..., Any], options: Any, garden: dict[str, Any]
) -> None:
    first, second = (make(**garden) for _ in range(2))
    first.reset(seed=4)
    second.reset(seed=4)
    with pytest.raises(ResetOptionError, match=r"^reset: "):
        first.reset(seed=5, options=options)
    for _ in range(3):
        for env in (first, second):
            env.reset()
        one, other = (getattr(env, "game", env).state() for env in (first, second))
        assert np.array_equal(one, other)


@pytest.mark.parametrize("item", [3, None, ["watered(north)"]])
def test_an_initial_state_of_what_are_no_literals(item: object, garden: dict[str, Any]) -> None:
    with pytest.raises(StateError, match=re.escape(str(item))):
        office_v0.raw_env(**garden).reset(options={"initial": [item]})


@pytest.mark.parametrize("make", MAKERS)
@pytest.mark.parametrize("answers", [(1, 1), (0, 0)])
def test_after_the_end_nothing_is_left_but_to_do_nothing(
    make: Callable[..., Any], garden: dict[str, Any], answers: tuple[int, int]
) -> None:
    """An empty mask would be sampled as action 0 without a word."""
    env = make(**garden, max_cycles=2, exogenous_while_thinking=True)
    env.reset(seed=0, options={"initial": ["watered(north)"]})
    for answer in answers:
        assert _seen(env, ROBOT)["action_mask"].all()
        _step(env, answer)
    for agent in (ROBOT, ADVERSARY):
        seen = _seen(env, agent)
        assert np.flatnonzero(seen["action_mask"]).tolist() == [0]
        assert env.observation_space(agent).contains(seen)


@pytest.mark.parametrize("make", MAKERS)
def test_a_sweep_is_refused_until_one_condition_is_chosen(
    make: Callable[..., Any], garden: dict[str, Any], tmp_path: Path
) -> None:
    given = {"name": "dry", **garden, "sweep": {"grid": {"limits.steps": [3, 7]}}}
    path = tmp_path / "dry.yaml"
    path.write_text(json.dumps(given), encoding="utf-8")
    swept = load_config(path)
    for config in (path, str(path), swept):
        with pytest.raises(ConfigError) as caught:
            make(config)
        (line,) = caught.value.lines
        assert line.startswith("dry: ")
        assert '["limits.steps=3"]' in line
        assert "sweep={}" in line
    for steps in (3, 7):
        env = make(conditions_of(swept)[f"limits.steps={steps}"])
        env.reset(seed=1)
        taken = 0
        while env.agents and not _is_over(env):
            _step(env, 0)
            taken += 1
        assert taken == steps
    make(path, sweep={}).reset(seed=1)


def _is_over(env: Any) -> bool:
    return any(getattr(env, "truncations", {}).values())
