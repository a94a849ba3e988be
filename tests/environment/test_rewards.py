"""Rewards by configuration: each is what the equations make of the game that was played."""

from collections.abc import Mapping
from dataclasses import dataclass, field
from math import inf
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from testbed import office_v0
from testbed.environment import ADVERSARY, ROBOT
from testbed.environment.aec import AECView
from testbed.world import World
from tests import games
from tests.games import DOMAINS, config_of

FINISH = 1


@dataclass
class Trace:
    """A game as it was played: a state more than there are answers, events and rewards."""

    states: list[int] = field(default_factory=list)
    answers: list[str] = field(default_factory=list)
    events: list[str] = field(default_factory=list)
    rewards: list[Mapping[str, float]] = field(default_factory=list)
    outcome: str | None = None

    @property
    def value(self) -> float:
        """What the goal is worth to the robot at the end."""
        return 0.0 if self.outcome is None else 1.0 if self.outcome == "achieved" else -1.0


def played(env: AECView, seed: int, goal: tuple[str, ...]) -> Trace:
    """A random game; where the goal holds, or now and then, the robot says that it does."""
    choose, trace, core = np.random.default_rng(seed), Trace(), env.core
    env.reset(seed=seed)
    rate = choose.choice([0.05, 0.3])
    assert env.rewards == {ROBOT: 0.0, ADVERSARY: 0.0}
    while trace.outcome is None:
        state = core.situation.state
        trace.states.append(state)
        possible = [
            index
            for index, action in enumerate(core.robot_actions)
            if action in core.world.agent_actions and core.world.executable(state, [action])
        ]
        done = core.world.satisfies(state, goal) or choose.random() < 0.08
        idle = choose.random() < 0.1 or not possible
        answer = FINISH if done else 0 if idle else int(choose.choice(possible))
        env.step(answer)
        legal = np.flatnonzero(env.observe(ADVERSARY)["action_mask"])
        event = int(choose.choice(legal)) if choose.random() < rate else 0
        env.step(event)
        trace.answers.append(core.robot_actions[answer])
        trace.events.append(core.adversary_actions[event])
        trace.rewards.append(dict(env.rewards))
        trace.outcome = core.situation.ending
    trace.states.append(core.situation.state)
    return trace


def _costs(world: World) -> Mapping[str, int]:
    """Execution units; where a description states none, each action has one."""
    stated = world.description.costs
    return stated if any(stated.values()) else dict.fromkeys(stated, 1)


def _units(world: World, trace: Trace) -> int:
    return sum(_costs(world).get(answer, 0) for answer in trace.answers)


def _potentials(world: World, goal: tuple[str, ...], steps: int) -> dict[int, float]:
    """Minus what is left to do; out of reach, what the steps of a game can cost at most."""
    costs = _costs(world)
    most = steps * max(costs.values())
    least = games.least_costs(world, goal, costs)
    return {state: -(most if cost == inf else cost) for state, cost in least.items()}


def _fail(world: World, goal: tuple[str, ...], trace: Trace) -> float:
    stayed = all(games.reaches(world, state, goal) for state in trace.states)
    return float(stayed and trace.outcome != "achieved")


def _waste(world: World, goal: tuple[str, ...], trace: Trace) -> float:
    fewest = games.least_costs(world, goal, _costs(world))[trace.states[0]]
    return max(0.0, _units(world, trace) - fewest)


def _regret(world: World, goal: tuple[str, ...], trace: Trace) -> float:
    events = {step: e for step, e in enumerate(trace.events, start=1) if e != "none"}
    fewest = games.least_knowing(world, trace.states[0], goal, _costs(world), events)
    return max(0.0, _units(world, trace) - fewest)


AT_THE_END = {"fail": _fail, "waste": _waste, "regret": _regret}


@pytest.mark.parametrize("kind", ["zero_sum", *AT_THE_END])
@pytest.mark.parametrize("name", DOMAINS)
def test_rewards_are_those_of_the_game_that_was_played(
    name: str, kind: str, tmp_path: Path
) -> None:
    goal, steps = tuple(DOMAINS[name].goal), 12
    rewards: dict[str, Any] = {"step": 0.25, "shaping": 0.5, "discount": 0.9, "adversary": kind}
    env = office_v0.raw_env(
        config_of(tmp_path, name, goal_feedback=False),
        max_cycles=steps,
        adversary={"cost": 0.125},
        rewards=rewards,
    )
    world = env.core.world
    potentials = _potentials(world, goal, steps)
    told = set()
    for seed in range(16):
        trace = played(env, seed, goal)
        last = len(trace.answers) - 1
        for number, rewarded in enumerate(trace.rewards):
            before, after = (potentials[s] for s in trace.states[number : number + 2])
            over = number == last
            robot = -0.25 + (trace.value if over else 0.0)
            robot += 0.5 * (0.9 * (0.0 if over else after) - before)
            assert rewarded[ROBOT] == pytest.approx(robot)
            value = -robot if kind == "zero_sum" else 0.0
            if over and kind in AT_THE_END:
                value = AT_THE_END[kind](world, goal, trace)
                told.add(value)
            paid = 0.0 if trace.events[number] == "none" else 0.125
            assert rewarded[ADVERSARY] == pytest.approx(value - paid)
    assert len(told) > 1 or kind == "zero_sum"


@pytest.mark.parametrize("name", DOMAINS)
def test_shaping_adds_the_difference_of_potentials_to_an_episode(name: str, tmp_path: Path) -> None:
    """Whatever is played, so that of two policies the better one stays the better one."""
    goal, steps = tuple(DOMAINS[name].goal), 10
    file = config_of(tmp_path, name)
    shaped = office_v0.raw_env(file, max_cycles=steps, rewards={"shaping": 2.0})
    plain = office_v0.raw_env(file, max_cycles=steps)
    potentials = _potentials(plain.core.world, goal, steps)
    for seed in range(8):
        with_it, without = (played(env, seed, goal) for env in (shaped, plain))
        assert with_it.answers == without.answers
        added = [a[ROBOT] - b[ROBOT] for a, b in zip(with_it.rewards, without.rewards, strict=True)]
        start = potentials[with_it.states[0]]
        for number, state in enumerate(with_it.states[1:-1], start=1):
            assert sum(added[:number]) == pytest.approx(2.0 * (potentials[state] - start))
        assert sum(added) == pytest.approx(2.0 * (0.0 - start))


def _ends_illegally(env: Any, steps: int) -> dict[str, float]:
    """Discounted sums of a game in which the adversary answers illegally after so many steps."""
    draw, core, discount = np.random.default_rng(steps), env.core, env.core.rules.rewards.discount
    earned = dict.fromkeys(env.agents, 0.0)
    padding = int(env.action_space(ADVERSARY).n) - 1
    for number in range(steps + 1):
        answer = int(draw.integers(2, len(core.robot_actions)))
        event = padding if number == steps else 0
        if isinstance(env, AECView):
            env.step(answer)
            env.step(event)
            rewarded = env.rewards
        else:
            _, rewarded, *_ = env.step({ROBOT: answer, ADVERSARY: event})
        for agent, own in rewarded.items():
            earned[agent] += discount**number * own
    return earned


@pytest.mark.parametrize("make", [office_v0.raw_env, office_v0.parallel_env])
@pytest.mark.parametrize("kind", ["zero_sum", "fail"])
@pytest.mark.parametrize("name", DOMAINS)
def test_what_shaping_adds_does_not_depend_on_an_illegal_end(
    name: str, kind: str, make: Any, tmp_path: Path
) -> None:
    rewards = {"adversary": kind, "shaping": 2.0, "discount": 0.9}
    file = config_of(tmp_path, name)
    env = make(file, illegal="terminate", padded=True, rewards=rewards)
    goal, core = tuple(DOMAINS[name].goal), env.core
    potentials = _potentials(core.world, goal, core.rules.steps)
    for steps in (0, 1, 4):
        env.reset(seed=steps)
        added = -2.0 * potentials[core.situation.state]
        earned = _ends_illegally(env, steps)
        assert earned[ROBOT] == pytest.approx(added)
        shared = added if kind == "zero_sum" else 0.0
        assert earned[ADVERSARY] == pytest.approx(-(0.9**steps) - shared)


def test_where_the_bound_strikes_the_rewards_do_not_guess(tmp_path: Path) -> None:
    file = config_of(tmp_path, "harbour")
    for kind in ("fail", "waste", "regret"):
        given = {"rewards": {"adversary": kind}, "limits": {"judge_states": 1, "steps": 6}}
        env = office_v0.raw_env(file, **given)
        trace = played(env, 1, ("stands(mate,east)", "-stands(mate,east)"))
        assert trace.outcome != "achieved"
        assert _units(env.core.world, trace) > 13
        assert trace.rewards[-1][ADVERSARY] == 0.0


def test_by_default_rewards_are_those_of_the_goal_alone(tmp_path: Path) -> None:
    given = {"robot": "goal", "adversary": "zero_sum", "step": 0.0, "shaping": 0.0}
    rules = {"budget": None, "per_object": {}, "cooldown": 0, "cost": 0.0, "events": None}
    file = config_of(tmp_path, "harbour")
    envs = [
        office_v0.raw_env(file),
        office_v0.raw_env(file, rewards=given, adversary={**rules, "fair": False}),
    ]
    assert envs[0].observation_spaces == envs[1].observation_spaces
    goal, outcomes = tuple(DOMAINS["harbour"].goal), set()
    for seed in range(6):
        one, other = (played(env, seed, goal) for env in envs)
        assert one == other
        assert one.rewards[-1] == {ROBOT: one.value, ADVERSARY: -one.value}
        assert all(r == {ROBOT: 0.0, ADVERSARY: 0.0} for r in one.rewards[:-1])
        outcomes.add(one.outcome)
    assert len(outcomes) > 1
