"""The environment plays by tables what its core would play, whoever looks at the core, and when."""

from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from testbed import office_v0
from testbed.environment import ADVERSARY, ROBOT, Core, IllegalActionError, Rules
from testbed.environment import tabled as module
from testbed.environment.aec import AECView
from testbed.environment.tabled import has_tables
from tests.environment.coarse import DOMAINS, random_world, write_domain
from tests.literals import parsed
from tests.world.test_world_random import laws

everywhere = pytest.mark.parametrize("name", ["office", *DOMAINS])
OPTIONS: list[dict[str, Any]] = [
    {},
    {"goal_feedback": False, "exogenous_while_thinking": True},
    {"adversary": {"fair": True}, "illegal": "noop"},
    {"illegal": "terminate"},
]


def _both(name: str, folder: Path, **options: Any) -> tuple[AECView, AECView]:
    """The environment, and one that always asks its core."""
    config = "office" if name == "office" else str(write_domain(folder, name))
    fast, slow = (office_v0.raw_env(config, max_cycles=8, **options) for _ in range(2))
    assert fast._tabled is not None
    slow._tabled = None
    return fast, slow


def _plain(value: Any) -> Any:
    if isinstance(value, dict):
        return {key: _plain(own) for key, own in value.items()}
    return (value.tolist(), str(value.dtype)) if isinstance(value, np.ndarray) else value


def _shown(env: AECView) -> list[Any]:
    """All that PettingZoo shows of a moment."""
    told = [env.agents, env.agent_selection, env.rewards, env._cumulative_rewards]
    ends = [env.terminations, env.truncations, env.infos]
    seen = [_plain(env.observe(agent)) for agent in (ROBOT, ADVERSARY)]
    return [*map(_plain, (*told, *ends)), *seen, *map(_plain, env.last())]


def _moments(env: AECView, seed: int, looks: float, wrong: float) -> Iterator[list[Any]]:
    """A random game; now and then somebody looks at the core, or answers outside the mask."""
    draw = np.random.default_rng(seed)
    env.reset(seed=None if seed % 3 == 1 else seed)  # after a seeded game
    while env.agents:
        yield _shown(env)
        agent = env.agent_selection
        mask = env.observe(agent)["action_mask"]
        legal = np.flatnonzero(mask)
        answer = int(legal[draw.integers(len(legal))])
        if draw.random() < wrong and not mask.all():
            answer = int(np.flatnonzero(mask == 0)[0])
        if draw.random() < looks:
            yield [env.core.situation, env.core.percept, env.render()]
        dead = env.terminations[agent] or env.truncations[agent]
        try:
            env.step(None if dead else answer)
        except IllegalActionError as error:
            yield [str(error)]
    yield [env.core.situation, env.core.random_state]


@everywhere
@pytest.mark.parametrize("options", OPTIONS)
def test_it_is_the_game_of_the_core(name: str, options: dict[str, Any], tmp_path: Path) -> None:
    fast, slow = _both(name, tmp_path, render_mode="ansi", **options)
    for seed in range(6):
        looks, wrong = (seed % 3) / 4, (seed % 2) / 5
        both = (_moments(env, seed, looks, wrong) for env in (fast, slow))
        for one, other in zip(*both, strict=True):
            assert one == other


@settings(max_examples=30, deadline=None)
@given(st.lists(laws(), min_size=1, max_size=7))
def test_so_it_is_in_random_descriptions(drawn: list[str]) -> None:
    world = random_world(drawn)
    states = tuple(world.states())
    fast, slow = (AECView(Core(world, Rules(parsed(["f"]), steps=6), states)) for _ in range(2))
    slow._tabled = None
    for seed in range(3):
        both = (_moments(env, seed, 0.2, 0.2) for env in (fast, slow))
        for one, other in zip(*both, strict=True):
            assert one == other


@everywhere
def test_it_goes_on_from_where_somebody_has_led_the_core(name: str, tmp_path: Path) -> None:
    """Back to a snapshot of the environment or of the core, or on by a step of the core itself."""
    fast, slow = _both(name, tmp_path)
    for seed in range(8):
        told = []
        for env in (fast, slow):
            draw, seen = np.random.default_rng(seed), list[Any]()
            env.reset(seed=seed)
            saved = [env.snapshot()]
            for _ in range(12):
                choice = draw.integers(4)
                if choice == 0:
                    saved.append(env.snapshot())
                elif choice == 1:
                    env.restore(saved[int(draw.integers(len(saved)))])
                elif choice == 2 and env.agent_selection == ROBOT and env.agents:
                    core = env.core.snapshot()
                    env.core.advance(env.core.robot_actions[0])
                    env.core.restore(core)
                elif env.agents and not any((*env.last()[2:4],)):
                    env.step(0)
                seen.append([_shown(env) if env.agents else None, env.core.situation])
            told.append(seen)
        assert told[0] == told[1]


def test_beyond_a_number_of_rows_all_are_forgotten(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(module, "MOST_ROWS", 3)
    fast, slow = _both("office", tmp_path)
    for seed in range(4):
        both = (_moments(env, seed, 0.0, 0.0) for env in (fast, slow))
        for one, other in zip(*both, strict=True):
            assert one == other
    assert fast._tabled is not None
    assert len(fast._tabled._rows) <= 3


@pytest.mark.parametrize(
    "options",
    [
        {"level": "L1"},
        {"adversary": {"budget": 3}},
        {"adversary": {"cost": 0.5}},
        {"rewards": {"step": 0.1}},
        {"observability": {"exo_move": {"mode": "always"}}},
        {"observability": {"exo_move": {"mode": "never", "false_reports": 0.1}}},
    ],
)
def test_other_games_have_none(options: dict[str, Any]) -> None:
    env = office_v0.raw_env(**options)
    assert not has_tables(env.core)
    assert env._tabled is None
