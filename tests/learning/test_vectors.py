"""Games against table robots: as a vector environment by tables, and as single environments."""

from functools import partial
from pathlib import Path
from typing import Any

import gymnasium
import numpy as np
import pytest
from gymnasium.utils.env_checker import check_env, data_equivalence
from gymnasium.vector import AutoresetMode, SyncVectorEnv
from gymnasium.wrappers.vector import RecordEpisodeStatistics

from testbed import office_v0
from testbed.config import ConfigError
from testbed.environment import Core, IllegalActionError, ResetOptionError, UnknownOptionError
from testbed.environment.tables import TableError, Tables
from testbed.learning import CHEAPEST, AdversaryEnv, AdversaryVectorEnv, Table
from testbed.protocol import RobotLost
from testbed.search import cheapest_plan
from tests.environment.coarse import DOMAINS, write_domain

ID = "testbed/Adversary-v0"
GAMES, STEPS, LIMIT = 4, 24, 7
MODES = tuple(AutoresetMode)


COSTS: dict[str, Any] = {"rewards": {"step": 2.0}, "adversary": {"cost": 0.5}}
"""With these the robot earns less than nothing where it achieves its goal."""


@pytest.fixture(params=["office", "pots", "ferry"])
def config(request: pytest.FixtureRequest, tmp_path: Path) -> str:
    """A domain in which nothing is drawn besides the state in which a game begins."""
    return _config(request.param, tmp_path)


def _config(name: str, folder: Path) -> str:
    return name if name == "office" else str(write_domain(folder, name))


def _start(core: Core, random: np.random.Generator) -> dict[str, list[str]]:
    """The option by which all games begin in one state."""
    assert not callable(core.initial)
    state = int(random.choice(np.array(core.initial, object)))
    return {"initial": [*map(str, core.world.literals(state))]}


def _robot(kind: str, core: Core, random: np.random.Generator) -> str | Table:
    """A robot by plans, or one that does anything."""
    if kind == CHEAPEST:
        return kind
    tables = Tables(core)
    tables.make_all(tables.states[:])
    return {state: int(random.integers(len(core.robot_actions))) for state in tables.states}


def _picked(masks: np.ndarray, random: np.random.Generator) -> np.ndarray:
    return np.array([random.choice(np.flatnonzero(mask)) for mask in masks])


@pytest.mark.parametrize(("kind", "form"), [(CHEAPEST, "dict"), ("anything", "flat")])
@pytest.mark.parametrize("mode", MODES)
def test_it_returns_what_single_environments_return(
    config: str, mode: AutoresetMode, kind: str, form: str
) -> None:
    random = np.random.default_rng(MODES.index(mode))
    core = office_v0.make_core(config)
    options = _start(core, random) | {"illegal": "noop" if kind == CHEAPEST else "error"}
    options |= {"robot": _robot(kind, core, random), "max_cycles": LIMIT, "config": config}
    options |= COSTS if kind == CHEAPEST else {}
    make = partial(gymnasium.make, ID, observations=form, **options)
    singles = SyncVectorEnv([make] * GAMES, autoreset_mode=mode)
    env = gymnasium.make_vec(ID, GAMES, autoreset_mode=mode, observations=form, **options)
    assert isinstance(env, AdversaryVectorEnv)
    assert env.metadata["autoreset_mode"] is mode
    assert env.observation_space == singles.observation_space
    assert env.action_space == singles.action_space
    assert data_equivalence(env.reset(seed=1), singles.reset(seed=1))
    for _ in range(STEPS):
        events = env.action_space.sample()
        if options["illegal"] == "error":
            events = _picked(env.action_masks(), random)
        found, wanted = env.step(events), singles.step(events)
        assert data_equivalence(found, wanted)
        over = found[2] | found[3]
        if mode is AutoresetMode.DISABLED and over.any():
            began = [own.reset(options={"reset_mask": over}) for own in (env, singles)]
            assert data_equivalence(*began)


@pytest.mark.parametrize("name", ["office", *DOMAINS])
def test_games_begin_in_states_that_are_drawn(name: str, tmp_path: Path) -> None:
    env = AdversaryVectorEnv(64, config=_config(name, tmp_path))
    one, again = (env.reset(seed=4) for _ in range(2))
    assert data_equivalence(one, again)
    assert env.observation_space.contains(one[0])
    other, _ = env.reset()
    assert not data_equivalence(one[0], other)


def test_who_follows_cheapest_plans_wastes_nothing(config: str) -> None:
    """Undisturbed it achieves the goal, where it can be achieved."""
    env = AdversaryEnv(config, CHEAPEST, max_cycles=15)
    core, costs = env.game.core, env.game.core.world.description.costs
    units = costs if any(costs.values()) else dict.fromkeys(costs, 1)
    for seed in range(5):
        env.reset(seed=seed)
        plan = cheapest_plan((core.world, core.situation.state, core.rules.goal), units)
        over = False
        while not over:
            _, _, terminated, truncated, _ = env.step(0)
            over = terminated or truncated
        assert core.achieved == (plan is not None)
        assert core.situation.units == sum(map(units.__getitem__, plan or ()))


@pytest.mark.filterwarnings("error")
def test_gymnasiums_checks_pass(config: str) -> None:
    env = AdversaryEnv(config, CHEAPEST, illegal="noop", max_cycles=12)
    check_env(env, skip_render_check=True)
    vector = gymnasium.make_vec(ID, GAMES, robot=CHEAPEST, config=config, illegal="noop")
    counted = RecordEpisodeStatistics(vector)
    counted.reset(seed=1)
    for _ in range(STEPS):
        seen, *_ = counted.step(vector.action_space.sample())
        assert vector.observation_space.contains(seen)
    vector.close()
    assert gymnasium.make_vec(vector.spec).num_envs == GAMES


def test_a_robot_that_reasons_plays_in_single_environments() -> None:
    env = gymnasium.make_vec(ID, 2, robot="traditional", autoreset_mode=AutoresetMode.SAME_STEP)
    assert isinstance(env, SyncVectorEnv)
    assert env.metadata["autoreset_mode"] is AutoresetMode.SAME_STEP
    env.close()


def test_a_state_that_a_table_lacks_is_told_and_the_games_begin_anew() -> None:
    core = office_v0.make_core()
    options = _start(core, np.random.default_rng(1))
    state = core.world.state(options["initial"])
    moves = core.world.moves(state)
    action = next(own for own, reached in moves if reached != state)
    table = {state: core.robot_actions.index(action)}
    for env in (AdversaryEnv(robot=table, **options), AdversaryVectorEnv(2, table, **options)):
        events = np.zeros(2, int) if isinstance(env, AdversaryVectorEnv) else 0
        for _ in range(2):
            env.reset(seed=1)
            with pytest.raises(RobotLost, match="loc"):
                env.step(events)
            with pytest.raises(IllegalActionError, match="reset"):
                env.step(events)


@pytest.mark.parametrize(
    "options",
    [
        {"robot": {0: 99}},
        {"robot": np.zeros(5, int)},
        {"robot": {"kitchen": 1}},
        {"robot": CHEAPEST, "link": "zenoh"},
        {"robot": CHEAPEST, "observations": "long"},
        {"robot": CHEAPEST, "config": "levels"},
    ],
)
def test_what_cannot_be_played_is_refused(options: dict[str, Any]) -> None:
    for make in (gymnasium.make, gymnasium.make_vec):
        with pytest.raises(ConfigError):
            make(ID, **options)


def test_what_tables_do_not_have_is_refused() -> None:
    with pytest.raises(TableError):
        AdversaryVectorEnv(2, adversary={"budget": 1})
    for options in ({"robot": "intentional"}, {"render_mode": "ansi"}, {"illegal": "terminate"}):
        with pytest.raises(ConfigError):
            AdversaryVectorEnv(2, **options)
    with pytest.raises(ConfigError, match="num_envs"):
        AdversaryVectorEnv(0)
    with pytest.raises(ConfigError, match="num_envs"):
        gymnasium.make_vec(ID, 0, robot="traditional")
    env = AdversaryVectorEnv(2)
    with pytest.raises(IllegalActionError):
        env.step([0, 0])
    with pytest.raises(IllegalActionError):
        env.action_masks()
    with pytest.raises(UnknownOptionError):
        env.reset(options={"inital": []})
    with pytest.raises(ResetOptionError):
        env.reset(options=[])  # type: ignore[arg-type]
