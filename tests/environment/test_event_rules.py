"""What the rules leave to the adversary: the mask is their definition, and nothing else."""

import copy
import pickle
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from pettingzoo.test import api_test, parallel_api_test

from testbed import office_v0
from testbed.environment import ADVERSARY, ROBOT, IllegalActionError
from testbed.environment.aec import AECView
from tests import games
from tests.games import DOMAINS, config_of
from tests.greenhouse import GREENHOUSE

WAIT, FINISH, NONE = 0, 1, 0
Played = list[tuple[int, str]]


@dataclass
class Definition:
    """The rules, as docs/game.md defines them, without any code of the environment."""

    sorts: Mapping[str, Sequence[str]]
    budget: int | None = None
    per_object: Mapping[str, int] | None = None
    cooldown: int = 0
    events: Sequence[str] | None = None
    fair: bool = False

    def allow(self, event: str, step: int, played: Played) -> bool:
        name, arguments = _parts(event)
        if self.events is not None and name not in self.events and event not in self.events:
            return False
        if self.budget is not None and len(played) >= self.budget:
            return False
        if any(step - earlier <= self.cooldown for earlier, _ in played):
            return False
        for sort, most in (self.per_object or {}).items():
            for own in self.sorts[sort]:
                before = sum(own in _parts(other)[1] for _, other in played)
                if own in arguments and before >= most:
                    return False
        return True


def _parts(action: str) -> tuple[str, list[str]]:
    name, _, rest = action.rstrip(")").partition("(")
    return name, rest.split(",") if rest else []


RULES: list[dict[str, Any]] = [
    {"budget": 0},
    {"budget": 3},
    {"cooldown": 2},
    {"budget": 4, "cooldown": 1},
    {"per_object": "own"},
    {"fair": True},
    {"events": "first"},
    {"budget": 6, "cooldown": 1, "per_object": "own", "events": "first", "fair": True},
]


def _rules(name: str, rules: dict[str, Any], events: Sequence[str]) -> dict[str, Any]:
    """The rules in the words of a domain: of events the first one, and all of the last name."""
    found = dict(rules)
    if "per_object" in found:
        found["per_object"] = DOMAINS[name].per_object
    if "events" in found:
        found["events"] = [events[0], events[-1].partition("(")[0]]
    return found


def _moves(env: AECView, seed: int, steps: int) -> Iterator[str]:
    """Plays at random by the masks; gives the robot's action of each step before the event."""
    choose = np.random.default_rng(seed)
    env.reset(seed=seed)
    for _ in range(steps):
        answers = [n for n in range(len(env.core.robot_actions)) if n != FINISH]
        answer = int(choose.choice(answers))
        env.step(answer)
        yield env.core.robot_actions[answer]
        legal = np.flatnonzero(env.observe(ADVERSARY)["action_mask"])
        env.step(int(choose.choice(legal[legal > 0] if len(legal) > 1 else legal)))


@pytest.mark.parametrize("thinking", [False, True])
@pytest.mark.parametrize("rules", RULES, ids=lambda rules: "-".join(rules))
@pytest.mark.parametrize("name", DOMAINS)
def test_the_mask_is_what_the_rules_say(
    name: str, rules: dict[str, Any], thinking: bool, tmp_path: Path
) -> None:
    file = config_of(tmp_path, name, exogenous_while_thinking=thinking)
    plain = office_v0.raw_env(file).core
    world, goal = plain.world, DOMAINS[name].goal
    given = _rules(name, rules, world.exogenous_actions)
    env = office_v0.raw_env(file, adversary=given)
    definition = Definition(world.description.sorts, **given)
    refused = 0
    for seed in range(2):
        played: Played = []
        for answer in _moves(env, seed, 12):
            now = env.core.situation
            plain.restore(env.core.snapshot())
            observation = env.observe(ADVERSARY)
            assert env.observation_space(ADVERSARY).contains(observation)
            played = [*now.played]
            possible = plain.events(answer)  # which other tests hold to the world
            for event, legal in zip(
                env.core.adversary_actions, observation["action_mask"], strict=True
            ):
                allowed = event == "none" or (
                    event in possible
                    and definition.allow(event, now.step, played)
                    and (not definition.fair or _is_fair(world, now.state, answer, event, goal))
                )
                assert bool(legal) is allowed, (answer, event, played)
                why = env.core.why_not(answer, event)
                assert (why is None) is allowed
                refused += event in possible and not allowed
    assert refused


def _is_fair(world: Any, state: int, answer: str, event: str, goal: Sequence[str]) -> bool:
    """Whether the goal is within reach of everything that the step may lead to."""
    own = [answer] if answer != "wait" and world.executable(state, [answer]) else []
    return all(games.reaches(world, s, goal) for s in world.successors(state, [*own, event]))


def _index(env: Any, action: str) -> int:
    core = env.unwrapped.core
    return (core.robot_actions if action in core.robot_actions else core.adversary_actions).index(
        action
    )


@pytest.mark.parametrize(
    ("rules", "first", "then", "told"),
    [
        ({"budget": 1}, "gust(green)", "crack(green)", "adversary.budget"),
        ({"cooldown": 3}, "gust(green)", "crack(green)", "until step 5 (adversary.cooldown)"),
        ({"per_object": {"lantern": 1}}, "gust(green)", "crack(green)", "per_object.lantern"),
        ({"events": ["gust"]}, "gust(green)", "crack(green)", "adversary.events"),
        ({"fair": True}, "gust(green)", "crack(red)", "adversary.fair"),
    ],
)
def test_an_event_that_the_rules_refuse_is_refused_with_the_reason(
    rules: dict[str, Any], first: str, then: str, told: str, tmp_path: Path
) -> None:
    file = config_of(tmp_path, "lanterns", exogenous_while_thinking=True)
    env = office_v0.raw_env(file, adversary=rules)
    env.reset(seed=0)
    env.step(WAIT)
    env.step(_index(env, first))
    env.step(WAIT)
    before = env.core.snapshot()
    with pytest.raises(IllegalActionError) as error:
        env.step(_index(env, then))
    assert told in str(error.value)
    assert env.core.snapshot() == before


def test_what_a_search_cannot_tell_is_not_fair(tmp_path: Path) -> None:
    file = config_of(tmp_path, "lanterns", exogenous_while_thinking=True)
    env = office_v0.raw_env(file, adversary={"fair": True}, limits={"judge_states": 1})
    env.reset(seed=0)
    assert "limits.judge_states" in (env.core.why_not("wait", "crack(green)") or "")
    assert env.core.events("wait") == ("none",)


def test_what_is_left_stands_in_the_observation(tmp_path: Path) -> None:
    file = config_of(tmp_path, "lanterns", exogenous_while_thinking=True)
    rules = {"budget": 3, "cooldown": 2, "per_object": {"lantern": 2}}
    env, plain = office_v0.raw_env(file, adversary=rules), office_v0.raw_env(file)
    size = plain.observation_space(ADVERSARY)["observation"].shape[0]
    space = env.observation_space(ADVERSARY)["observation"]
    assert (space.shape, space.dtype) == ((size + 5,), np.int8)
    assert [*space.high[size:]] == [3, 2, 2, 2, 2]
    assert not space.low[size:].any()
    env.reset(seed=0)
    seen = []
    for event in ("gust(green)", "none", "none", "crack(green)", "none"):
        env.step(WAIT)
        seen.append([*env.observe(ADVERSARY)["observation"][size:]])
        env.step(_index(env, event))
    assert env.core.world.description.sorts["lantern"] == ("red", "green", "blue")
    budgets, cooldowns, *lanterns = zip(*seen, strict=True)
    assert budgets == (3, 2, 2, 2, 1)
    assert cooldowns == (0, 2, 1, 0, 2)
    assert lanterns == [(2, 2, 2, 2, 2), (2, 1, 1, 1, 0), (2, 2, 2, 2, 2)]


def test_false_reports_do_not_tell_the_robot_what_is_left(tmp_path: Path) -> None:
    """Otherwise it would hear no false report any more once the budget is used up."""
    told = {"silt": {"mode": "always", "false_reports": 1.0}}
    file = config_of(tmp_path, "harbour", observability=told)
    env = office_v0.raw_env(file, adversary={"budget": 0})
    env.reset(seed=0)
    env.step(_index(env, "sail(mate,east)"))
    env.step(NONE)
    (report,) = env.core.percept.events
    assert report.action.name == "silt"


def test_large_numbers_are_not_cut_off(tmp_path: Path) -> None:
    env = office_v0.raw_env(config_of(tmp_path, "lanterns"), adversary={"budget": 1_000})
    env.reset(seed=0)
    observation = env.observe(ADVERSARY)
    assert observation["observation"].dtype == env.observation_space(ADVERSARY)["observation"].dtype
    assert observation["observation"][-1] == 1_000
    assert env.observation_space(ADVERSARY).contains(observation)


@pytest.mark.filterwarnings(
    "error",
    # The same that is meant without the rules; see test_pettingzoo.
    "ignore:Observation is not a NumPy array",
    "ignore:Observation space for each agent probably should be",
    "ignore:Agents have different observation space sizes",
    "ignore:Observations are different shapes",
)
@pytest.mark.parametrize("budget", [2, 300])
def test_pettingzoos_own_tests_pass_under_the_rules(tmp_path: Path, budget: int) -> None:
    rules = {"budget": budget, "cooldown": 1, "per_object": {"crate": 2}, "fair": True, "cost": 0.5}
    given = {"adversary": rules, "rewards": {"adversary": "regret", "step": 0.1, "shaping": 0.5}}
    file = config_of(tmp_path, "harbour")
    api_test(office_v0.env(file, **given), num_cycles=100)
    parallel_api_test(office_v0.parallel_env(file, **given), num_cycles=60)


def test_in_the_parallel_view_what_is_not_legal_is_dropped_and_costs_nothing(
    tmp_path: Path,
) -> None:
    file = config_of(tmp_path, "harbour")
    env = office_v0.parallel_env(
        file, infos="text", adversary={"budget": 1, "cost": 2.0}, rewards={"adversary": "fail"}
    )
    _, _ = env.reset(seed=0)
    silt = _index(env, "silt(east)")

    def step(answer: int, event: int) -> tuple[str | None, float, int]:
        observations, rewards, _, _, infos = env.step({ROBOT: answer, ADVERSARY: event})
        left = int(observations[ADVERSARY]["observation"][-1])
        return infos[ADVERSARY]["dropped"], rewards[ADVERSARY], left

    ship = _index(env, "ship(mate,salt,west)")
    assert step(WAIT, silt) == ("silt(east)", 0.0, 1)
    assert step(ship, silt) == (None, -2.0, 0)
    sail = _index(env, "sail(mate,dock)")
    assert step(sail, _index(env, "silt(dock)")) == ("silt(dock)", 0.0, 0)


def test_in_the_parallel_view_an_event_may_be_fair_only_without_the_robots_action(
    tmp_path: Path,
) -> None:
    """Where the robot is just leaving, the crate is left behind in a berth that it cannot enter."""
    goal = ["lies(silk,west)"]
    initial = ["lies(silk,east)", "lies(salt,dock)", "stands(mate,east)"]
    file = config_of(tmp_path, "harbour", goal=goal, initial=initial)
    env = office_v0.parallel_env(file, adversary={"fair": True}, infos="text")
    observations, _ = env.reset(seed=0)
    silt = _index(env, "silt(east)")
    assert observations[ADVERSARY]["action_mask"][silt]
    sail = _index(env, "sail(mate,dock)")
    *_, infos = env.step({ROBOT: sail, ADVERSARY: silt})
    assert infos[ADVERSARY]["dropped"] == "silt(east)"


@pytest.mark.parametrize("copied", [copy.deepcopy, lambda own: pickle.loads(pickle.dumps(own))])
def test_a_game_restored_goes_on_equally(copied: Any, tmp_path: Path) -> None:
    rules = {"budget": 5, "cooldown": 1, "per_object": {"crate": 2}, "fair": True}
    given = {"adversary": rules, "rewards": {"adversary": "regret", "shaping": 1.0}}
    env = office_v0.raw_env(config_of(tmp_path, "harbour"), **given)
    for _ in _moves(env, 4, 6):
        pass
    snapshot, other = env.snapshot(), copied(env)

    def play(player: AECView) -> list[Any]:
        choose, seen = np.random.default_rng(1), []
        for _ in range(20):
            observation = player.observe(player.agent_selection)
            seen.append([part.tolist() for part in observation.values()] + [{**player.rewards}])
            player.step(int(choose.choice(np.flatnonzero(observation["action_mask"] > 0))))
            if not player.agents or player.terminations[ROBOT]:
                break
        return seen

    first = play(env)
    env.restore(snapshot)
    assert play(env) == first == play(other)


def test_by_default_nothing_is_added(tmp_path: Path) -> None:
    (tmp_path / "pots.al").write_text(GREENHOUSE, encoding="utf-8")
    text = 'name: pots\ndomain: pots.al\ngoal: ["stands(fern,sill)"]\n'
    (tmp_path / "pots.yaml").write_text(text, encoding="utf-8")
    env = office_v0.raw_env(tmp_path / "pots.yaml")
    # 6 places of pots; wait, finish and 6 actions of the robot; none and 6 events.
    for agent, entries, actions in ((ROBOT, 6, 8), (ADVERSARY, 14, 7)):
        space = env.observation_space(agent)
        assert [*space] == ["action_mask", "observation"]
        seen, mask = space["observation"], space["action_mask"]
        assert (seen.shape, seen.dtype) == ((entries,), np.int8)
        assert (seen.low == -1).all()
        assert (seen.high == 1).all()
        assert (mask.n, env.action_space(agent).n) == (actions, actions)
    env.reset(seed=1, options={"initial": ["stands(fern,floor)", "stands(rose,bench)"]})
    observation = env.observe(ADVERSARY)
    assert observation["observation"].dtype == observation["action_mask"].dtype == np.int8
    assert observation["observation"].tolist() == [-1, -1, 1, 1, -1, -1] + [0] * 8
    for answer in (_index(env, "carry(gardener,fern,sill)"), FINISH):
        assert env.rewards == {ROBOT: 0.0, ADVERSARY: 0.0}
        env.step(answer)
        env.step(NONE)
    assert env.rewards == {ROBOT: 1.0, ADVERSARY: -1.0}
