"""Many games at once against the single environment, game by game, in random play."""

import re
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from gymnasium.vector import AutoresetMode

from testbed.config import ConfigError
from testbed.environment import ADVERSARY, ROBOT, IllegalActionError
from testbed.environment.aec import AECView
from testbed.environment.tables import TableError
from testbed.learning import Batch, Moves
from testbed.office_v0 import raw_env
from tests.environment.coarse import DOMAINS, write_domain

GAMES, STEPS, LIMIT = 8, 25, 7
CONFIGS = ("office", *DOMAINS)
SAME_STEP, NEXT_STEP, DISABLED = (
    AutoresetMode.SAME_STEP,
    AutoresetMode.NEXT_STEP,
    AutoresetMode.DISABLED,
)


COSTS = {"rewards": {"step": 0.25}, "adversary": {"cost": 0.5}}


def _config(name: str, folder: Path) -> str:
    return name if name == "office" else str(write_domain(folder, name))


def _batch(config: str, mode: AutoresetMode = SAME_STEP, seed: int = 1, **options: object) -> Batch:
    return Batch(config, GAMES, seed=seed, autoreset_mode=mode, max_cycles=LIMIT, **options)


def _begun(config: str, state: int, **options: object) -> AECView:
    """A single environment in a state."""
    env = raw_env(config, max_cycles=LIMIT, **options)
    env.reset(seed=0, options={"initial": env.core.world.literals(state)})
    return env


def _picked(masks: np.ndarray, random: np.random.Generator) -> np.ndarray:
    """A legal answer of each game."""
    return np.array([random.choice(np.flatnonzero(mask)) for mask in masks])


def _put(env: AECView, state: int) -> None:
    """Let a drawn outcome be this one, which has to be possible."""
    (situation, random), turn = env.snapshot()
    env.restore(((replace(situation, state=state), random), turn))


@pytest.mark.parametrize(
    "options", [{}, {"goal_feedback": False}, {"exogenous_while_thinking": True, **COSTS}]
)
@pytest.mark.parametrize("name", CONFIGS)
def test_each_game_is_the_single_one(name: str, options: dict[str, object], tmp_path: Path) -> None:
    config, random = _config(name, tmp_path), np.random.default_rng(5)
    batch = _batch(config, DISABLED, **options)
    singles = [_begun(config, state, **options) for state in batch.states]
    for _ in range(STEPS):
        sight = batch.robot_sight()
        for env, *shown in zip(singles, *sight, strict=True):
            _is_shown(env, ROBOT, shown)
        robot = _picked(sight.action_mask, random)
        for env, answer in zip(singles, robot, strict=True):
            env.step(int(answer))
        sight = batch.adversary_sight(robot)
        for env, *shown in zip(singles, *sight, strict=True):
            _is_shown(env, ADVERSARY, shown)
        events = _picked(sight.action_mask, random)
        before = [env.core.situation.state for env in singles]
        moves = batch.step(robot, events)
        for game, env in enumerate(singles):
            _plays_on(env, int(events[game]), before[game], batch.states[game])
            _has_come_of_it(env, moves, game)
        over = moves.terminated | moves.truncated
        assert np.array_equal(moves.ended, np.flatnonzero(over))
        batch.begin(over)
        for game in moves.ended:
            singles[game] = _begun(config, batch.states[game], **options)


def _is_shown(env: AECView, agent: str, shown: list[np.ndarray]) -> None:
    own = env.observe(agent)
    assert np.array_equal(shown[0], own["observation"])
    assert np.array_equal(shown[1], own["action_mask"])
    assert {part.dtype for part in shown} == {np.dtype(np.int8)}


def _plays_on(env: AECView, event: int, before: int, state: int) -> None:
    """The single game takes the same event; where its outcome is drawn it is that of the batch."""
    core = env.core
    env.step(event)
    answer, happened = core.situation.answer, core.situation.happened
    if core.situation.state != state:
        assert answer is not None
        compound = [answer] * bool(happened) + [core.adversary_actions[event]] * (event > 0)
        assert state in core.world.successors(before, compound)
        _put(env, state)


def _has_come_of_it(env: AECView, moves: Moves, game: int) -> None:
    for agent in (ROBOT, ADVERSARY):
        assert moves.rewards[agent][game] == env.rewards[agent]
        assert moves.terminated[game] == env.terminations[agent]
        assert moves.truncated[game] == env.truncations[agent]
        if game in moves.ended:
            final = moves.final[agent][list(moves.ended).index(game)]
            assert np.array_equal(final, env.observe(agent)["observation"])


def _played(batch: Batch, steps: int, seed: int = 3) -> list[Moves]:
    """So many steps of random play."""
    random, found = np.random.default_rng(seed), []
    for _ in range(steps):
        robot = _picked(batch.robot_sight().action_mask, random)
        found.append(batch.step(robot, _picked(batch.adversary_sight(robot).action_mask, random)))
    return found


@pytest.mark.parametrize("name", CONFIGS)
def test_a_game_begins_anew_in_the_same_step(name: str, tmp_path: Path) -> None:
    batch = _batch(_config(name, tmp_path))
    starts = {batch.tables.states[position >> 1] for position in batch.tables.starts_at}
    for moves in [_played(batch, 1, seed)[0] for seed in range(3 * LIMIT)]:
        states = batch.states
        assert all(states[game] in starts for game in moves.ended)
        assert batch.robot_sight().action_mask.all()


@pytest.mark.parametrize("name", CONFIGS)
def test_a_game_begins_anew_in_the_next_step(name: str, tmp_path: Path) -> None:
    batch = _batch(_config(name, tmp_path), NEXT_STEP, **COSTS)
    over: set[int] = set()
    begun = 0
    for seed in range(3 * LIMIT):
        mask = batch.robot_sight().action_mask
        assert {game for game in range(GAMES) if mask[game].sum() == 1} == over
        (moves,) = _played(batch, 1, seed)
        for game in over:
            assert not moves.terminated[game]
            assert not moves.truncated[game]
            assert moves.rewards[ROBOT][game] == moves.rewards[ADVERSARY][game] == 0
            assert 2 * batch.tables.number(batch.states[game]) in batch.tables.starts_at
        begun += len(over)
        over = set(moves.ended.tolist())
    assert begun


def test_what_a_game_is_told_to_do_when_it_begins_anew_means_nothing() -> None:
    batches = [_batch("office", NEXT_STEP) for _ in range(2)]
    for batch in batches:
        finish = np.full(GAMES, batch.robot_actions.index("finish"))
        while not batch.step(finish, np.zeros(GAMES, int)).terminated.all():
            pass
    nothing, something = np.zeros(GAMES, int), np.ones(GAMES, int)
    batches[0].step(nothing, nothing)
    batches[1].step(something + 1, something)
    assert batches[0].states == batches[1].states


def test_the_same_seed_plays_the_same_games() -> None:
    def rewards(seed: int) -> list[list[float]]:
        batch = _batch("office", seed=seed)
        return [moves.rewards[ROBOT].tolist() + batch.states for moves in _played(batch, 20)]

    assert rewards(1) == rewards(1) != rewards(2)


def test_some_games_begin_anew_when_it_is_asked_for() -> None:
    batch = _batch("office", DISABLED)
    before = batch.states
    _played(batch, 3)
    moved = batch.states
    batch.begin(np.arange(GAMES) < 2, seed=4)
    assert batch.states[2:] == moved[2:]
    batch.begin(seed=1)
    assert batch.states == before


@pytest.mark.parametrize(
    ("robot", "event", "word"),
    [
        ([99] * GAMES, [0] * GAMES, "99"),
        ([-1] * GAMES, [0] * GAMES, "-1"),
        ([0] * GAMES, [99] * GAMES, "99"),
        ([0] * (GAMES - 1), [0] * GAMES, str(GAMES)),
        ([0.5] * GAMES, [0] * GAMES, "float"),
        ([0] * (GAMES - 1) + [1], [1] * GAMES, "game 0"),
    ],
)
def test_answers_that_are_none_are_refused_and_play_nothing(
    robot: list[float], event: list[int], word: str
) -> None:
    batch = _batch("office")
    before = batch.states
    with pytest.raises(IllegalActionError, match=re.escape(word)):
        batch.step(robot, event)
    assert batch.states == before


def test_a_game_that_is_over_and_does_not_begin_by_itself_is_not_played() -> None:
    batch = _batch("office", DISABLED)
    while not len(_played(batch, 1)[0].ended):
        pass
    with pytest.raises(IllegalActionError):
        batch.step(np.zeros(GAMES, int), np.zeros(GAMES, int))


@pytest.mark.parametrize("name", CONFIGS)
def test_an_illegal_event_may_count_as_action_0(name: str, tmp_path: Path) -> None:
    config, random = _config(name, tmp_path), np.random.default_rng(8)
    tolerant, strict = (_batch(config, illegal=kind, **COSTS) for kind in ("noop", "error"))
    illegal = 0
    for _ in range(STEPS):
        robot = random.integers(len(strict.robot_actions), size=GAMES)
        events = random.integers(len(strict.adversary_actions), size=GAMES)
        legal = strict.adversary_sight(robot).action_mask[np.arange(GAMES), events]
        given = events.copy()
        moves, others = tolerant.step(robot, given), strict.step(robot, events * legal)
        assert tolerant.states == strict.states
        assert np.array_equal(given, events)
        assert np.array_equal(moves.ended, others.ended)
        assert np.array_equal(moves.rewards[ADVERSARY], others.rewards[ADVERSARY])
        illegal += int((legal == 0).sum())
    assert illegal


@pytest.mark.parametrize("options", [{"illegal": "terminate"}, {"padded": True}, {"infos": "text"}])
def test_conventions_that_a_batch_does_not_have_are_refused(options: dict[str, object]) -> None:
    with pytest.raises(ConfigError, match=next(iter(options))):
        Batch(games=2, **options)


def test_tables_that_grow_hold_the_same_games(monkeypatch: pytest.MonkeyPatch) -> None:
    wanted = _batch("office")
    monkeypatch.setattr("testbed.environment.tables.FIRST", 1)
    grown = _batch("office")
    assert grown.tables.following.dtype.itemsize > 1
    for seed in range(STEPS):
        played = [_played(batch, 1, seed)[0].rewards[ROBOT].tolist() for batch in (wanted, grown)]
        assert played[0] == played[1]
        assert wanted.states == grown.states


def test_a_fine_game_is_refused() -> None:
    with pytest.raises(TableError):
        Batch(level="L1", games=2)
