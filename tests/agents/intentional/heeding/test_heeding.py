"""What a robot heeds of what it sees, by `relevance`: each rule in a domain that needs it."""

import json
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import pytest
import yaml
from typer.testing import CliRunner

from asp.language import Literal
from asp.reasoning.successors import Transitions
from asp.solving import LimitError, State
from testbed.cli import app
from testbed.config import config_names, load_config
from testbed.experiment.plan import plan_trials
from testbed.experiment.robots import make_robot
from testbed.experiment.storyteller import Moment
from testbed.experiment.trial import play_trial
from testbed.link import InProcessRobot
from tests.agents.intentional.heeding.domains import (
    BLOCKS,
    BY_A_DEFINITION,
    CANAL,
    DITCHES,
    IN_THE_EFFECT,
    SMITHY,
    port,
)

Event = tuple[int, str]


@pytest.fixture(autouse=True)
def _here(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)


def _played(
    text: str,
    initial: Sequence[str],
    goal: str,
    events: Sequence[Event],
    relevance: str = "",
    robot: str = "intentional",
) -> list[Moment]:
    """The steps of a trial in the domain with these events, of which the robot is not told."""
    Path("own.al").write_text(text, encoding="utf-8")
    keys = {
        "name": "own",
        "domain": "own.al",
        "goal": [goal],
        "initial": list(initial),
        "script": [{"step": step, "action": action} for step, action in events],
        "exogenous_while_thinking": True,
        "robots": [robot],
    }
    Path("own.yaml").write_text(yaml.safe_dump(keys), encoding="utf-8")
    overrides = [f"relevance={relevance}"] if relevance else []
    (spec,) = plan_trials(load_config("own.yaml", overrides))
    moments = list[Moment]()
    record = play_trial(spec, InProcessRobot(make_robot), moments.append).record
    assert record.achieved
    told = [m.decision.trace.unheeded for m in moments if m.decision.trace.unheeded is not None]
    assert record.unheeded_steps == (sum(map(bool, told)) if told else None)
    return moments


def _attempts(moments: Sequence[Moment]) -> list[str]:
    return [moment.decision.action for moment in moments if moment.happened is not None]


ROBOTS = pytest.mark.parametrize("robot", ["intentional", "intentional-plain"])
SHIP_LEAVES = [(1, "tow(brig,east)")]


def _looking(places: Sequence[str], relevance: str = "") -> list[Moment]:
    """The ship is believed in the south, beyond the west, and is seen to the other side."""
    values = {"S": "brig", "B": "south", "R": "pilot"}
    moored = f"moors({','.join(values[place] for place in places)})"
    start = ["stands(pilot,north)", moored]
    return _played(port(*places), start, "aboard(pilot,brig)", SHIP_LEAVES, relevance)


@pytest.mark.parametrize("places", ["SB", "BS", "SBR"])
def test_what_the_goal_names_is_heeded_whatever_the_value_and_wherever_it_stands(
    places: str,
) -> None:
    assert _attempts(_looking(places)) == ["walk(pilot,east)", "board(pilot,brig)"]


@pytest.mark.parametrize("places", ["SB", "BS", "SBR"])
def test_the_released_controller_walks_past_what_it_looks_for(places: str) -> None:
    attempts = _attempts(_looking(places, "published"))
    assert attempts[:3] == ["walk(pilot,west)", "walk(pilot,south)", "board(pilot,brig)"]
    assert len(attempts) > 3


def test_what_is_seen_against_the_belief_and_not_heeded_is_on_record() -> None:
    past, found = _looking("SB", "published"), _looking("SB")
    seen = [(m.percept.step, m.decision.trace.unheeded) for m in past if m.decision.trace.unheeded]
    # Beside it in the north the ship is seen, and from the west that it is not in the south.
    assert seen[:2] == [(2, ["moors(brig,east)"]), (3, ["-moors(brig,south)"])]
    assert not any(moment.decision.trace.unheeded for moment in found)


@ROBOTS
def test_a_defined_goal_is_changed_by_what_defines_it(robot: str) -> None:
    """Cube b, on c at first, is knocked down while the robot starts to put a on b."""
    start = ["on(a,ground)", "on(b,c)", "on(c,ground)"]
    moments = _played(BLOCKS, start, "above(a,c)", [(1, "knock(b,ground)")], robot=robot)
    assert _attempts(moments) == ["put(a,c)"]
    assert all(moment.decision.trace.no_plan is None for moment in moments)


@pytest.mark.parametrize(("relevance", "finishes"), [("published", 2), ("definition", 1)])
def test_a_goal_depends_on_what_its_definitions_depend_on(relevance: str, finishes: int) -> None:
    """The inlet is clogged, unseen by a robot that looks at the last definition only."""
    clogged = [(1, "clog(inlet)")]
    moments = _played(DITCHES, ["opened(inlet)"], "flows(lower)", clogged, relevance)
    assert [m.decision.action for m in moments].count("finish") == finishes


THROUGH = ["floats(barge,spring)"]


@ROBOTS
@pytest.mark.parametrize(
    ("relevance", "attempts"),
    [
        ("published", ["sail(barge,mill)", "sail(barge,delta)", "crank(barge,weir)"]),
        ("definition", ["sail(barge,mill)", "sail(barge,delta)", "crank(barge,weir)"]),
        ("plan", ["sail(barge,mill)", "crank(barge,weir)"]),
        ("all", ["sail(barge,mill)", "crank(barge,weir)"]),
    ],
)
def test_a_lock_on_the_way_is_heeded_for_the_plan(
    relevance: str, attempts: list[str], robot: str
) -> None:
    goal, closed = "floats(barge,delta)", [(2, "turn(weir)")]
    moments = _played(CANAL, THROUGH, goal, closed, relevance, robot)
    assert _attempts(moments) == [*attempts, "sail(barge,delta)"]


@pytest.mark.parametrize("text", [SMITHY, IN_THE_EFFECT, BY_A_DEFINITION])
@pytest.mark.parametrize(
    ("relevance", "attempts"),
    [
        ("definition", ["heat(smith,blade)", "strike(smith,blade)", "call(smith,apprentice)"]),
        ("plan", ["heat(smith,blade)", "call(smith,apprentice)"]),
    ],
)
def test_a_helper_who_walked_off_is_missed_for_the_plan(
    relevance: str, attempts: list[str], text: str
) -> None:
    left = [(2, "stroll(apprentice,yard)")]
    moments = _played(text, ["waits(apprentice,anvil)"], "forged(blade)", left, relevance)
    assert _attempts(moments) == [*attempts, "strike(smith,blade)"]


@pytest.mark.parametrize(
    ("relevance", "attempts"), [("published", ["crank(barge,weir)"]), ("definition", [])]
)
def test_what_the_next_action_names_is_heeded_once_the_activity_is_started(
    relevance: str, attempts: list[str]
) -> None:
    """Somebody opens the gate while the robot starts an activity that begins with opening it."""
    start = ["floats(barge,mill)", "closed(weir)"]
    moments = _played(CANAL, start, "floats(barge,delta)", [(1, "turn(weir)")], relevance)
    assert _attempts(moments) == [*attempts, "sail(barge,delta)"]


def _against(relevance: str) -> dict[int, set[str]]:
    """By step what the robot sees, believes to be otherwise, and does not heed."""
    dredged = [(2, "dredge(mill)"), (3, "dredge(spring)")]
    moments = _played(CANAL, THROUGH, "floats(barge,delta)", dredged, relevance)
    return {m.percept.step: set(m.decision.trace.unheeded or ()) for m in moments}


def test_what_the_last_action_names_is_heeded() -> None:
    """A pool is dredged as the robot comes there, and the one that it came from after it left."""
    published, definition = _against("published"), _against("definition")
    assert published[3] == {"dredged(mill)"}
    assert published[4] == {"dredged(mill)", "dredged(spring)"}
    # The move from the spring to the mill is about both, that from the mill on about the mill.
    assert definition[3] == set()
    assert definition[4] == {"dredged(spring)"}
    assert not any(_against("all").values())


def test_what_the_last_action_changed_is_heeded() -> None:
    """The helper comes to the anvil, which the call does not name, and it is cracked by then."""
    start = ["waits(apprentice,yard)", "hot(blade)"]
    for relevance, against in (("published", {"cracked(anvil)"}), ("definition", set[str]())):
        moments = _played(SMITHY, start, "forged(blade)", [(2, "crack(anvil)")], relevance)
        assert moments[1].decision.action == "call(smith,apprentice)"
        assert set(moments[2].decision.trace.unheeded or ()) == against


def test_conditions_of_what_is_done_are_not_heeded_for_the_plan() -> None:
    """The gate is closed behind the robot, that goes on."""
    closed = [(2, "turn(weir)")]
    moments = _played(CANAL, ["floats(barge,mill)"], "floats(barge,gulf)", closed, "plan")
    assert _attempts(moments) == ["sail(barge,delta)", "sail(barge,gulf)"]
    assert moments[2].decision.trace.unheeded == ["closed(weir)"]


def test_a_limit_is_reached_there_as_elsewhere(monkeypatch: pytest.MonkeyPatch) -> None:
    """Where the robot cannot find out what its action leads to, it waits a step and says why."""
    asked = Transitions.outcomes
    reasons = [LimitError("used up")]

    def limited(own: Transitions, *given: Any) -> set[State]:
        if reasons:
            raise reasons.pop()
        return asked(own, *given)

    life = (CANAL, THROUGH, "floats(barge,delta)", [], "definition")
    unlimited = _played(*life)
    monkeypatch.setattr(Transitions, "outcomes", limited)
    moments = _played(*life)
    assert not reasons
    (waits,) = (m.decision for m in moments if m.decision.trace.reason == "used up")
    assert waits.action == "wait"
    assert len(moments) == len(unlimited) + 1
    assert _attempts(moments) == _attempts(unlimited)


def test_the_baseline_looks_at_its_outcome_whatever_is_relevant() -> None:
    goal, closed = "floats(barge,delta)", [(1, "turn(weir)")]
    for relevance in ("published", "all"):
        moments = _played(CANAL, THROUGH, goal, closed, relevance, "traditional")
        assert _attempts(moments) == [
            "sail(barge,mill)",
            "sail(barge,delta)",
            "crank(barge,weir)",
            "sail(barge,delta)",
        ]


FINE = {
    "name": "fine",
    "levels": ["row"],
    "level_sizes": {"row": {"rooms": 4, "rows": 1, "columns": 2, "objects": [[2, 1]]}},
    "goal": ["in_hand(rob1,object1)"],
    "initial": [
        "fine_loc(rob1,room1_1)",
        "fine_loc(object1_1,room3_1)",
        "fine_loc(object2_1,room4_1)",
    ],
    "script": [{"at_action": 1, "action": "fine_exo_move(object1_1,room2_1)"}],
    "robots": ["intentional"],
    "limit": 1,
}


@pytest.mark.parametrize("relevance", ["published", "definition", "plan", "all"])
def test_it_is_the_same_at_the_fine_resolution(relevance: str) -> None:
    """The object comes from the third room into the second one, through which the robot goes.

    Only a robot that heeds everything bears the other object in mind.
    """
    Path("fine.yaml").write_text(yaml.safe_dump(FINE), encoding="utf-8")
    (spec,) = plan_trials(load_config("fine.yaml", [f"relevance={relevance}"]))
    beliefs = list[Literal]()

    def tell(moment: Moment) -> None:
        beliefs.extend(moment.decision.trace.belief)

    record = play_trial(spec, InProcessRobot(make_robot), tell).record
    assert any("object2" in each.arguments for each in beliefs) == (relevance == "all")
    actions = [attempt.action for attempt in record.actions]
    if relevance == "published":
        assert actions[:2] == ["move(rob1,room2)", "move(rob1,room3)"]
        assert record.unheeded_steps
    else:
        assert actions == ["move(rob1,room2)", "pickup(rob1,object1)"]
        assert record.unheeded_steps == 0


def test_a_trial_with_another_relevance_is_another_trial_with_the_same_seed() -> None:
    specs = {
        each: plan_trials(load_config("table1", ["limit=2", f"relevance={each}"]))
        for each in ("published", "definition", "plan", "all")
    }
    assert len({spec.trial for own in specs.values() for spec in own}) == 4 * len(specs["all"])
    assert len({tuple(spec.seed for spec in own) for own in specs.values()}) == 1


def test_the_published_studies_heed_what_the_released_controller_did() -> None:
    relevances = {name: load_config(name).relevance for name in config_names()}
    published = {name for name, relevance in relevances.items() if relevance == "published"}
    assert published == {"quickstart", "table1", "levels", "ties"}
    assert set(relevances.values()) == {"published", "definition"}


def test_a_replay_tells_what_was_not_heeded() -> None:
    _looking("SB")  # writes the configuration
    arguments = ["run", "own.yaml", "relevance=published", "link=inprocess", "--out", "own"]
    assert CliRunner().invoke(app, [*arguments, "--quiet"]).exit_code == 0
    (line,) = Path("own/trials.jsonl").read_text(encoding="utf-8").splitlines()
    told = CliRunner().invoke(app, ["replay", "own", "--trial", json.loads(line)["trial"]])
    assert told.exit_code == 0
    found = [line.split() for line in told.stdout.splitlines() if "unheeded" in line]
    assert found[:2] == [["unheeded", "moors(brig,east)"], ["unheeded", "-moors(brig,south)"]]


def test_an_unknown_relevance_is_refused_in_one_line() -> None:
    refused = CliRunner().invoke(app, ["check", "office", "relevance=plans"])
    assert refused.exit_code == 2
    (line,) = refused.stderr.splitlines()
    assert "relevance" in line
    assert "plan" in line.replace("plans", "")
