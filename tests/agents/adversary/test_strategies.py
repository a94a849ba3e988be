"""What strategies do, against their definitions by brute force, in domains of no common word."""

from collections import deque
from collections.abc import Callable, Iterator, Mapping, Sequence
from math import inf
from pathlib import Path

import pytest
from typer.testing import CliRunner

from asp.language import Literal
from testbed.cli import app
from testbed.config import load_config
from testbed.experiment.plan import plan_trials
from testbed.experiment.robots import make_robot
from testbed.experiment.storyteller import Moment
from testbed.experiment.trial import play_trial
from testbed.link import InProcessRobot
from testbed.protocol import FINISH, WAIT
from testbed.world import World, load_world
from tests.agents.adversary.domains import PARTS, spec_in

Worths = Mapping[Literal, object]
Definition = Callable[[World, Sequence[Moment], Sequence[Literal]], Worths]
"""What events are worth at the last of some moments, and what the goal is."""

everywhere = pytest.mark.parametrize("domain", PARTS)
SEEDS = range(4)


def played(folder: Path, domain: str, *overrides: str) -> tuple[World, list[Moment]]:
    spec = spec_in(folder, domain, *overrides)
    moments: list[Moment] = []
    record = play_trial(spec, InProcessRobot(make_robot), moments.append).record
    assert record.outcome not in ("error", "robot_lost"), record.reason
    return load_world(spec.setting.domain), moments


def own(world: World, state: int, moment: Moment) -> tuple[Literal, ...]:
    """The robot's part of what happens at a moment, if it happens in a state."""
    action = moment.decision.action
    if action in (WAIT, FINISH) or not world.executable(state, [action]):
        return ()
    return (action,)


def alone(world: World, moment: Moment) -> int:
    """The state that would follow without an event."""
    return world.successor(moment.before, own(world, moment.before, moment))


def following(world: World, moment: Moment) -> Iterator[tuple[Literal, int]]:
    """The events that are possible at a moment, with the state that follows each."""
    for event in world.exogenous_actions if moment.decision.action != FINISH else ():
        found = world.successors(moment.before, (*own(world, moment.before, moment), event))
        if found:
            (after,) = found
            yield event, after


def check(tmp_path: Path, domain: str, strategy: str, worths: Definition) -> None:
    """At each step one of the events that are worth most happens, and each of them at some time."""
    goal, acted, tied, drawn = PARTS[domain][1], 0, 0, 0
    for seed in SEEDS:
        world, moments = played(tmp_path, domain, f"adversary.strategy={strategy}", f"seed={seed}")
        for number, moment in enumerate(moments, start=1):
            found = worths(world, moments[:number], [*map(Literal.parse, goal)])
            most = max(found.values(), default=None)  # type: ignore[type-var]
            best = [event for event, worth in found.items() if worth == most]
            assert moment.event in (best or [None]), (seed, number)
            acted += bool(best)
            tied += len(best) > 1
            drawn += len(best) > 1 and moment.event != best[0]
    assert acted
    assert bool(tied) == bool(drawn)


def restored(world: World, moments: Sequence[Moment], _: object) -> Worths:
    """How many of the literals an event restores that the robot's last action changed."""
    changed: set[Literal] = set()
    for moment in moments[:-1]:
        before, after = ({*world.literals(s)} for s in (moment.before, moment.after))
        changed = (before - {*world.literals(alone(world, moment))} - after) or changed
    now = moments[-1]
    lacking = changed - {*world.literals(alone(world, now))}
    found = {e: len(lacking & {*world.literals(s)}) for e, s in following(world, now)}
    return {event: number for event, number in found.items() if number}


@everywhere
def test_a_meddler_restores_most_of_what_the_last_action_changed(
    domain: str, tmp_path: Path
) -> None:
    check(tmp_path, domain, "meddler", restored)


def steps_left(world: World, state: int, goal: Sequence[Literal]) -> float:
    """By breadth-first search over all that the robot can do."""
    left, known = deque([(state, 0)]), {state}
    while left:
        state, steps = left.popleft()
        if world.satisfies(state, goal):
            return steps
        for action in world.agent_actions:
            for after in world.successors(state, [action]):
                if after not in known:
                    known.add(after)
                    left.append((after, steps + 1))
    return inf


def lengthened(world: World, moments: Sequence[Moment], goal: Sequence[Literal]) -> Worths:
    """How far the goal is after an event, where that is further than without one."""
    now = moments[-1]
    without = steps_left(world, alone(world, now), goal)
    found = {event: steps_left(world, state, goal) for event, state in following(world, now)}
    return {event: steps for event, steps in found.items() if steps > without}


@everywhere
def test_a_greedy_adversary_takes_the_robot_furthest_from_its_goal(
    domain: str, tmp_path: Path
) -> None:
    check(tmp_path, domain, "greedy", lengthened)


def deceived(world: World, moments: Sequence[Moment], _: object) -> Worths:
    """Fewest of the changes seen, then most that are unseen and contradict what is believed."""
    now = moments[-1]
    believed = world.state(now.decision.trace.belief)
    expected = {*world.literals(world.successor(believed, own(world, believed, now)))}
    untouched = {*world.literals(alone(world, now))}
    found: dict[Literal, object] = {}
    for event, state in following(world, now):
        changed = {*world.literals(state)} - untouched
        seen = changed & {*world.visible(state, world.description.robots[0])}
        wrong = changed - seen - expected
        if wrong:
            found[event] = (-len(seen), len(wrong))
    return found


@everywhere
def test_against_a_belief_most_is_made_false_where_the_robot_sees_least(
    domain: str, tmp_path: Path
) -> None:
    check(tmp_path, domain, "belief", deceived)


@everywhere
def test_an_event_that_nobody_sees_leaves_the_robot_with_a_false_belief(
    domain: str, tmp_path: Path
) -> None:
    world, moments = played(tmp_path, domain, "adversary.strategy=belief", "limits.steps=4")
    first = next(m for m in moments if m.event is not None)
    after = next(m for m in moments if m.percept.step == first.percept.step + 1)
    true = {*world.true_atoms(after.before)}
    assert set(after.decision.trace.belief) != true


@everywhere
def test_without_a_mind_to_read_there_is_no_belief_to_contradict(
    domain: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    (tmp_path / "waiting_mindless.py").write_text(MINDLESS, encoding="utf-8")
    monkeypatch.syspath_prepend(tmp_path)
    robot = "robots=['waiting_mindless:Waiting']"
    for strategy, acts in (("belief", False), ("random", True)):
        given = (robot, f"adversary.strategy={strategy}", "adversary.rate=1")
        _, moments = played(tmp_path, domain, *given)
        assert any(moment.event for moment in moments) == acts


READERS = """\
class Reader:
    sees = ("trace",)

    def __init__(self, game, options): ...

    def reset(self, seed): ...

    def act(self, view):
        assert (view.trace is not None) == ("trace" in self.sees)
        assert not view.state and view.robot_action is None
        return "none"


class Blind(Reader):
    sees = ()
"""


@everywhere
@pytest.mark.parametrize("name", ["Reader", "Blind"])
def test_the_mind_of_a_robot_is_shown_to_who_declares_to_see_it(
    name: str, domain: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    (tmp_path / "readers_of_minds.py").write_text(READERS, encoding="utf-8")
    monkeypatch.syspath_prepend(tmp_path)
    _, moments = played(tmp_path, domain, f"adversary.strategy=readers_of_minds:{name}")
    assert moments


MINDLESS = """\
from testbed.protocol import Capabilities, Decision, Trace


class Waiting:
    capabilities = Capabilities()

    def begin(self, task): ...

    def act(self, percept):
        return Decision(
            trial=percept.trial,
            step=percept.step,
            action="wait",
            believes_goal=False,
            trace=Trace(),
        )
"""


@everywhere
def test_none_leaves_the_robot_alone(domain: str, tmp_path: Path) -> None:
    _, moments = played(tmp_path, domain, "adversary.strategy=none")
    assert not any(moment.event for moment in moments)


@pytest.mark.parametrize(("strategy", "pairs"), [("none", 1), ("meddler", 3)])
def test_repeats_of_which_nothing_is_drawn_are_played_once(
    strategy: str, pairs: int, tmp_path: Path
) -> None:
    spec_in(tmp_path, "ferry")
    given = ["goal=['lies(oats,north)']", "initial=null", "repeats=3"]
    config = load_config(str(tmp_path / "ferry.yaml"), [*given, f"adversary.strategy={strategy}"])
    states = len(load_world(config.domain).initial_states())
    assert len(plan_trials(config)) == pairs * states * len(config.robots)


@everywhere
@pytest.mark.parametrize("strategy", ["random", "meddler", "belief", "greedy"])
def test_a_strategy_keeps_within_the_rules(strategy: str, domain: str, tmp_path: Path) -> None:
    given = (f"adversary.strategy={strategy}", "adversary.rate=1", "limits.steps=30")
    rules = ("adversary.budget=2", "adversary.cooldown=2")
    steps = [m.percept.step for m in played(tmp_path, domain, *given, *rules)[1] if m.event]
    assert len(steps) in (1, 2)
    assert steps[-1] - steps[0] not in (1, 2)


def test_each_condition_of_a_sweep_has_its_own_strategy(tmp_path: Path) -> None:
    """Also in a domain without scenarios, in which nothing happens unless a strategy is given."""
    spec_in(tmp_path, "ferry")
    given = [
        "goal=['lies(oats,north)']",
        f"initial={PARTS['ferry'][2]}",
        "robots=[intentional]",
        "limits.steps=14",
        "sweep={conditions: {calm: {}, far: {adversary.strategy: greedy}}}",
    ]
    played = {}
    for spec in plan_trials(load_config(str(tmp_path / "ferry.yaml"), given)):
        played[spec.cell] = play_trial(spec, InProcessRobot(make_robot)).record
    calm, far = played["calm"], played["far"]
    assert (calm.scenario, calm.outcome, calm.exogenous) == (far.scenario, "achieved", [])
    assert far.exogenous


@pytest.mark.parametrize(
    ("strategy", "options", "parts"),
    [
        ("random", "{mix: {drift: 1}}", ["options.mix", "'drift'", "drag"]),
        ("random", "{mix: {drag: 0}}", ["weights"]),
        ("random", "{burst: 0.5}", ["burst", "0.5"]),
        ("random", "{delay: -1}", ["delay", "-1"]),
        ("greedy", "{gain: 0}", ["gain"]),
        ("greedy", "{measure: metres}", ["options.measure", "metres", "'actions'", "'units'"]),
        ("greedy", "{measure: 5}", ["options.measure"]),
        ("meddler", "{gain: 1}", ["options.gain", "meddler"]),
    ],
)
def test_a_wrong_option_is_answered_by_one_line(
    strategy: str, options: str, parts: list[str], tmp_path: Path
) -> None:
    spec_in(tmp_path, "ferry")
    given = ["goal=['lies(oats,north)']", f"adversary={{strategy: {strategy}}}"]
    options = f"adversary.options={options}"
    done = CliRunner().invoke(app, ["check", str(tmp_path / "ferry.yaml"), *given, options])
    (line,) = done.stderr.splitlines()
    assert done.exit_code == 2
    assert all(part in line for part in parts), line


@pytest.mark.parametrize(
    ("strategies", "options", "refused"),
    [
        ("[random]", "{burst: 2}", None),
        ("[greedy, optimal]", "{measure: units}", None),
        ("[random, greedy]", "{burst: 2}", "greedy"),
        ("[greedy, meddler]", "{measure: units}", "meddler"),
    ],
)
def test_options_of_a_swept_strategy_are_those_of_each_condition(
    strategies: str, options: str, refused: str | None, tmp_path: Path
) -> None:
    """And not those of the strategy that is played where nothing is swept."""
    spec_in(tmp_path, "ferry")
    sweep = f"sweep.grid={{adversary.strategy: {strategies}}}"
    given = ["goal=['lies(oats,north)']", "adversary.budget=1", f"adversary.options={options}"]
    done = CliRunner().invoke(app, ["check", str(tmp_path / "ferry.yaml"), *given, sweep])
    lines = done.stderr.splitlines()
    assert len(lines) == (refused is not None)
    for line in lines:
        assert line.startswith(f"command line: adversary.options.{options[1:].partition(':')[0]}: ")
        assert f"(of {refused})" in line


@everywhere
@pytest.mark.parametrize("strategy", ["meddler", "belief", "greedy"])
def test_a_rate_is_a_share_of_steps_and_all_follows_from_the_seed(
    strategy: str, domain: str, tmp_path: Path
) -> None:
    given = (f"adversary.strategy={strategy}", "limits.steps=30")
    events = {}
    for rate in (0.0, 0.3):
        runs = [
            [m.event for m in played(tmp_path, domain, *given, f"adversary.rate={rate}")[1]]
            for _ in range(2)
        ]
        assert runs[0] == runs[1]
        events[rate] = runs[0]
    assert not any(events[0.0])
