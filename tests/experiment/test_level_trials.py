"""Trials at the fine resolution with a robot that recites: what is recorded, told and replayed."""

from collections.abc import Sequence
from typing import Any

import pytest

from testbed.config import load_config
from testbed.experiment.digest import logical
from testbed.experiment.narration import narrator_of
from testbed.experiment.plan import plan_trials
from testbed.experiment.record import FineCounts, TrialRecord
from testbed.experiment.specs import TrialSpec
from testbed.experiment.trial import play_trial
from testbed.experiment.trial_setup import refinement_of, setup_of
from testbed.link import InProcessRobot
from testbed.protocol import Decision, FineTrace, Percept, Task, Trace
from testbed.world import world_of
from tests.literals import parsed

SMALL = "level_sizes={small: {rooms: 2, rows: 1, columns: 2, objects: [[2, 2]]}}"


def _specs(*overrides: str) -> list[TrialSpec]:
    given = ["robots=[intentional,traditional]", "limit=3", *overrides]
    return plan_trials(load_config("levels", given))


START = ("fine_loc(rob1,room1_1)", "fine_loc(object1_1,room1_2)", "fine_loc(object2_1,room2_1)")
FIXED = (
    SMALL,
    "levels=[small]",
    "limit=1",
    f"initial=[{','.join(START)}]",
    "goal=[loc(object1,room2)]",
    "statistics={}",
    "adversary.rate=0.0",
    "robots=[intentional]",
)


class Reciter:
    """A robot that recites concrete actions, each with the trace of its abstract one."""

    def __init__(self, steps: Sequence[tuple[str, FineTrace | None]]) -> None:
        self._steps = steps
        self.task: Task | None = None
        self.percepts: list[Percept] = []

    def begin(self, task: Task) -> None:
        self.task = task

    def act(self, percept: Percept) -> Decision:
        self.percepts.append(percept)
        action, fine = self._steps[percept.step - 1]
        trace = Trace(plans=1 if fine is None else 0, planning_time_s=0.5, fine=fine)
        return Decision(
            trial=percept.trial, step=percept.step, action=action, believes_goal=True, trace=trace
        )


def _fine(begun: int | None, abstract: str | None, **values: Any) -> FineTrace:
    return FineTrace(begun=begun, abstract=abstract, **values)


CARRYING = (
    ("wait", None),
    (
        "fine_move(rob1,room1_2)",
        _fine(2, "pickup(rob1,object1)", plans=1, actions=1, planning_time_s=0.25),
    ),
    ("test_fine_loc(rob1,rob1,room1_2)", _fine(2, "pickup(rob1,object1)", plans=1, actions=1)),
    ("fine_pickup(rob1,object1_1)", _fine(2, "pickup(rob1,object1)", plans=1, actions=2)),
    (
        "fine_move(rob1,room2_1)",
        _fine(5, "move(rob1,room2)", plans=2, actions=3, happened=True, infer_time_s=0.125),
    ),
    ("finish", _fine(None, None, plans=2, actions=3, happened=True)),
)


def _play(
    steps: Sequence[tuple[str, FineTrace | None]], *overrides: str
) -> tuple[TrialRecord, Reciter]:
    (spec,) = _specs(*FIXED, *overrides)
    robot = Reciter(steps)
    return play_trial(spec, InProcessRobot(lambda _: robot)).record, robot


def test_abstract_actions_are_recorded_with_what_was_inferred_of_them() -> None:
    record, _ = _play(CARRYING)
    assert record.reason is None
    assert (record.outcome, record.achieved, record.correct) == ("achieved", True, True)
    assert [(a.step, a.action, a.happened) for a in record.actions] == [
        (2, "pickup(rob1,object1)", True),
        (5, "move(rob1,room2)", True),
    ]
    assert (record.action_count, record.minimal_actions, record.execution_units) == (2, 2, 20)
    assert (record.level, record.scenario, record.plans) == ("small", "levels", 1)
    assert record.in_reach is None
    assert record.fine == FineCounts(
        plans=2, actions=3, tests=0, planning_time_s=0.25, infer_time_s=0.125
    )
    assert record.reasoning_time_s == pytest.approx(6 * 0.5 + 0.25 + 0.125)


def test_an_action_in_the_middle_of_which_the_trial_ends_did_not_happen() -> None:
    record, _ = _play(CARRYING[:3], "limits.steps=3")
    assert (record.outcome, record.in_reach) == ("step_limit", True)
    assert [(a.action, a.happened) for a in record.actions] == [("pickup(rob1,object1)", False)]


def test_the_robot_knows_of_the_fine_resolution_where_it_is_and_not_where_objects_are() -> None:
    _, robot = _play(CARRYING)
    assert robot.task is not None
    known = robot.task.initial_fine
    assert [literal for literal in known if not literal.startswith("-")] == [START[0]]
    assert {"-fine_loc(rob1,room2_2)", "-fine_in_hand(rob1,object1_2)"} <= set(known)
    assert not [literal for literal in known if "fine_loc(object" in literal]
    assert {"loc(object1,room1)", "-in_hand(rob1,object2)"} <= set(robot.task.initial)
    assert "magnify" in robot.task.refinement
    assert "sorts" in robot.task.source


def test_what_is_uncertain_excuses_a_longer_way() -> None:
    there_and_back = (
        ("wait", None),
        ("fine_move(rob1,room1_2)", _fine(2, "move(rob1,room2)", actions=1)),
        ("fine_move(rob1,room2_1)", _fine(2, "move(rob1,room2)", actions=2)),
        ("fine_move(rob1,room1_2)", _fine(4, "move(rob1,room1)", actions=3, happened=True)),
        ("fine_pickup(rob1,object1_1)", _fine(5, "pickup(rob1,object1)", actions=4)),
        ("fine_move(rob1,room2_1)", _fine(6, "move(rob1,room2)", actions=5)),
        ("finish", _fine(None, None)),
    )
    record, _ = _play(there_and_back)
    assert (record.achieved, record.action_count, record.correct) == (True, 4, False)
    uncertain, _ = _play(there_and_back, "statistics={test_fine_loc: 0.9}")
    assert (uncertain.achieved, uncertain.correct) == (True, True)


def test_a_failed_move_and_a_wrong_test_follow_from_the_seed() -> None:
    def play() -> dict[str, object]:
        record, _ = _play(CARRYING, "statistics={fine_move: 0.5}", "adversary.rate=0.5")
        return logical(record)

    assert play() == play()
    assert set(play()["fine"]) == {"plans", "actions", "tests"}  # type: ignore[call-overload]


def test_a_script_is_of_the_fine_resolution() -> None:
    script = "script=[{step: 3, action: 'fine_exo_move(object2_1,room1_1)'}]"
    record, _ = _play(CARRYING, script)
    assert [(e.step, e.action) for e in record.exogenous] == [
        (3, "fine_exo_move(object2_1,room1_1)")
    ]


def test_a_script_counts_concrete_actions_and_no_tests() -> None:
    script = "script=[{at_action: 2, action: 'fine_exo_move(object2_1,room1_1)'}]"
    record, _ = _play(CARRYING, script)
    assert [event.step for event in record.exogenous] == [4]
    again = "script=[{at_action: 2, action: 'fine_exo_move(object2_1,room2_1)'}]"
    skipped, _ = _play(CARRYING, again, "script_policy=skip")
    assert [own.step for own in skipped.rejected] == [4]
    assert skipped.exogenous == []


def _told(steps: Sequence[tuple[str, FineTrace | None]], *overrides: str) -> list[str]:
    """What a replay tells of the trial."""
    (spec,) = _specs(*FIXED, *overrides)
    said: list[str] = []
    robot = InProcessRobot(lambda _: Reciter(steps))
    teller, narrator = (
        setup_of(spec.setting).teller(spec.trial),
        narrator_of(spec.setting, said.append),
    )
    play_trial(spec, robot, lambda moment: narrator.tell(teller.tell(moment)))
    return said


def _step(said: Sequence[str], number: int) -> list[str]:
    """The lines of a step, each without its indentation and with one blank between words."""
    start = said.index(f"step {number}") + 1
    rest = [" ".join(line.split()) for line in said[start:]]
    return rest[: rest.index("")] if "" in rest else rest


def test_a_replay_tells_the_abstract_action_its_refined_plan_and_what_came_of_it() -> None:
    plan = [action for action, _ in CARRYING[1:4] if "test" not in action]
    begun = _fine(2, "pickup(rob1,object1)", zoomed=["object1", "room1"], plan=plan)
    failing = _fine(2, "pickup(rob1,object1)", failed="fine_move(rob1,room1_2) failed")
    over = _fine(
        5,
        "move(rob1,room2)",
        ended="pickup(rob1,object1)",
        happened=True,
        inferred=["in_hand(rob1,object1)"],
        committed=["fine_in_hand(rob1,object1_1)"],
    )
    steps = [*CARRYING]
    steps[1], steps[3], steps[4] = (
        (CARRYING[1][0], begun),
        (CARRYING[3][0], failing),
        (CARRYING[4][0], over),
    )
    said = _told(steps)
    assert _step(said, 1)[0] == (
        "world fine_loc(object1_1,room1_2) fine_loc(object1_2,room1_2) fine_loc(object2_1,room2_1) "
        "fine_loc(object2_2,room2_1) fine_loc(rob1,room1_1)"
    )
    assert _step(said, 2)[-4:] == [
        "abstract pickup(rob1,object1)",
        "relevant object1 room1",
        "refined to fine_move(rob1,room1_2) fine_pickup(rob1,object1_1)",
        "action fine_move(rob1,room1_2)",
    ]
    assert _step(said, 3)[0] == "world now fine_loc(rob1,room1_2) -fine_loc(rob1,room1_1)"
    assert "failed fine_move(rob1,room1_2) failed" in _step(said, 4)
    after = _step(said, 5)
    assert "certain now fine_in_hand(rob1,object1_1)" in after
    assert "over pickup(rob1,object1): happened" in after
    assert "inferred in_hand(rob1,object1)" in after
    assert after.index("inferred in_hand(rob1,object1)") < after.index("abstract move(rob1,room2)")


def test_a_replay_says_which_observation_is_wrong() -> None:
    test = ("test_fine_loc(rob1,object1_1,room1_2)", _fine(2, "pickup(rob1,object1)"))
    said = _told([*CARRYING[:2], test, *CARRYING[3:]], "statistics={test_fine_loc: 0.0}")
    assert "observed -fine_loc(object1_1,room1_2), which is wrong" in _step(said, 4)
    said = _told([*CARRYING[:2], test, *CARRYING[3:]])
    assert "observed fine_loc(object1_1,room1_2)" in _step(said, 4)


def test_a_replay_says_which_action_took_no_effect_and_what_others_did() -> None:
    script = "script=[{step: 3, action: 'fine_exo_move(object2_1,room1_1)'}]"
    said = _told(CARRYING, "statistics={fine_move: 0.0}", script)
    assert _step(said, 2)[-1] == "action fine_move(rob1,room1_2): did not happen"
    assert _step(said, 3)[-1] == "others fine_exo_move(object2_1,room1_1)"
    assert _step(said, 4)[0].startswith("world now fine_loc(object2_1,room1_1)")


def test_the_oracle_counts_abstract_actions() -> None:
    setup = setup_of(_specs("levels=[L1]")[0].setting)
    state = world_of(refinement_of(_specs("levels=[L1]")[0].setting)).state(
        ["fine_loc(rob1,room1_1)", "fine_loc(object1_1,room2_2)"]
    )
    alone, both = parsed(["loc(object1,room1)"]), parsed(["loc(object1,room1)", "loc(rob1,room2)"])
    assert setup.judge.minimal(state, alone, 1_000).actions == 3
    assert setup.judge.minimal(state, both, 1_000).actions == 5
