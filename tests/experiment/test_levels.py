"""Trials at the fine resolution: what is drawn, what is recorded, what the levels' table says."""

from collections import Counter
from collections.abc import Sequence
from typing import Any

import pytest

from testbed.config import ExperimentConfig, load_config
from testbed.environment.fine import fine_world
from testbed.experiment.level_table import LEVEL_COLUMNS, level_rows
from testbed.experiment.plan import TrialSpec, plan_trials
from testbed.experiment.published import NO_ZOOM, PARTS, PUBLISHED, RATIOS, ZOOM
from testbed.experiment.record import FineCounts, TrialRecord, logical
from testbed.experiment.stage import load_ground, load_stage
from testbed.experiment.summary import summarise
from testbed.experiment.tables import headings, rows_of
from testbed.experiment.telling import teller_of
from testbed.experiment.trial import play_trial
from testbed.link.inprocess import InProcessRobot
from testbed.link.messages import Decision, FineTrace, Percept, Task, Trace
from tests.experiment.samples import a_record

SMALL = "level_sizes={small: {rooms: 2, rows: 1, columns: 2, objects: [[2, 2]]}}"


def _config(*overrides: str) -> ExperimentConfig:
    return load_config("levels", ["robots=[intentional,traditional]", "limit=3", *overrides])


def _specs(*overrides: str) -> list[TrialSpec]:
    return plan_trials(_config(*overrides))


def test_a_pair_is_the_same_trial_for_each_robot() -> None:
    specs = _specs("levels=[L1,L2]")
    assert len(specs) == 2 * 3 * 2
    assert len({spec.trial for spec in specs}) == len(specs)
    for one, other in zip(specs[::2], specs[1::2], strict=True):
        assert (one.robot, other.robot) == ("intentional", "traditional")
        shared = [(s.pair, s.level, s.seed, s.initial, s.setting) for s in (one, other)]
        assert shared[0] == shared[1]
    assert len({spec.pair for spec in specs}) == 6


def _ids(*overrides: str) -> set[str]:
    return {spec.trial for spec in _specs("levels=[L1]", *overrides)}


@pytest.mark.parametrize(
    "override",
    [
        "seed=2",
        "statistics.fine_move=0.8",
        "adversary.rate=0.2",
        "adversary.pace=abstract",
        'draw.goal=["loc(object,room)", "-in_hand(robot,object)"]',
        "script=[]",
        "limits.steps=9",
        "observability.fine_exo_move.mode=always",
    ],
)
def test_what_a_result_may_depend_on_changes_every_id(override: str) -> None:
    assert not _ids() & _ids(override)


@pytest.mark.parametrize("override", ["draw.holding=1.0", "goal=[loc(object1,room2)]"])
def test_a_trial_that_comes_out_as_another_one_is_another_trial(override: str) -> None:
    assert _ids("limit=9") != _ids("limit=9", override)


def test_a_level_of_the_same_name_and_another_size_has_other_ids() -> None:
    def of_size(rooms: int) -> set[str]:
        size = f"{{rooms: {rooms}, rows: 1, columns: 2, objects: [[1, 1]]}}"
        return {s.trial for s in _specs("levels=[own]", f"level_sizes={{own: {size}}}")}

    assert not of_size(2) & of_size(3)


def test_neither_the_link_nor_a_larger_limit_nor_other_levels_change_an_id() -> None:
    assert _ids() == _ids("link=zenoh") < _ids("limit=5")
    assert _ids() < {spec.trial for spec in _specs("levels=[L2,L1]")}


def test_a_drawn_goal_is_a_room_in_which_the_object_is_not() -> None:
    for spec in _specs("levels=[L3]", "limit=20"):
        state = fine_world(load_ground(spec.setting).refinement).state(spec.initial)
        (goal,) = spec.setting.goal
        assert goal.startswith("loc(object")
        assert not fine_world(load_ground(spec.setting).refinement).satisfies(state, (goal,))


def test_goals_and_places_are_drawn_from_all() -> None:
    specs = _specs("levels=[L1]", "limit=200", "robots=[intentional]")
    drawn = Counter(spec.setting.goal for spec in specs)
    assert set(drawn) == {("loc(object1,room1)",), ("loc(object1,room2)",)}
    places = {atom for spec in specs for atom in spec.initial if "rob1,room" in atom}
    assert len(places) == 4
    held = sum(any("in_hand" in atom for atom in spec.initial) for spec in specs)
    assert 20 <= held <= 60  # of 200 at 0.2: a mean of 40 with a deviation of 5.7


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


def _fine(begun: int | None, abstract: str, **values: Any) -> FineTrace:
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
    ("finish", _fine(None, "", plans=2, actions=3, happened=True)),
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
    assert robot.task.initial_fine == ["fine_loc(rob1,room1_1)"]
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
        ("finish", _fine(None, "")),
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


def _told(steps: Sequence[tuple[str, FineTrace | None]], *overrides: str) -> list[str]:
    """What a replay tells of the trial."""
    (spec,) = _specs(*FIXED, *overrides)
    said: list[str] = []
    robot = InProcessRobot(lambda _: Reciter(steps))
    play_trial(spec, robot, teller_of(spec.setting, said.append).tell)
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


def test_out_of_reach_is_counted_apart() -> None:
    stage = load_stage(_specs("levels=[L1]")[0].setting)
    state = fine_world(load_ground(_specs("levels=[L1]")[0].setting).refinement).state(
        ["fine_loc(rob1,room1_1)", "fine_loc(object1_1,room2_2)"]
    )
    assert stage.minimal_actions(state, ["loc(object1,room1)"]) == 3
    assert stage.minimal_actions(state, ["loc(object1,room1)", "loc(rob1,room2)"]) == 5


def _level(
    trial: str, robot: str, achieved: bool = True, in_reach: bool | None = None, **times: float
) -> TrialRecord:
    counts = FineCounts(
        plans=2, planning_time_s=times.get("fine", 0.2), infer_time_s=times.get("infer", 0.1)
    )
    return a_record(
        f"{trial} {robot}",
        pair=trial,
        robot=robot,
        scenario="levels",
        level="L3",
        fine=counts,
        achieved=achieved,
        outcome="achieved" if achieved else "gave_up",
        in_reach=in_reach,
        planning_time_s=times.get("planning", 0.3),
        diagnosis_time_s=times.get("diagnosis", 0.4),
    )


def _columns(*records: TrialRecord) -> Any:
    summary: Any = summarise(records)
    return summary["levels"]["L3"]


def test_the_columns_are_means_and_deviations_of_a_trials_reasoning() -> None:
    columns = _columns(_level("a", ZOOM), _level("b", ZOOM, fine=0.4, planning=0.5))
    zoom = columns["reasoning"][ZOOM]
    assert zoom["fine"] == {"mean": pytest.approx(0.4), "sd": pytest.approx(0.02**0.5)}
    assert zoom["coarse"]["mean"] == pytest.approx(0.8)
    assert zoom["total"]["mean"] == pytest.approx(1.2)
    assert zoom["refined_plan"]["mean"] == pytest.approx(0.15)
    assert (zoom["trials"], zoom["achieved"], zoom["completed"]) == (2, 2, 1.0)
    assert columns["zoom_ratios"] == dict.fromkeys(PARTS)


def test_ratios_are_of_pairs_in_which_both_robots_achieved_the_goal() -> None:
    columns = _columns(
        _level("a", ZOOM, fine=0.2),
        _level("a", NO_ZOOM, fine=0.6),
        _level("b", ZOOM, fine=0.1),
        _level("b", NO_ZOOM, fine=0.9, achieved=False),
        _level("c", NO_ZOOM, fine=5.0),
    )
    assert columns["zoom_ratios"]["refined_plan"] == pytest.approx(3.0)
    assert columns["zoom_ratios"]["fine"] == pytest.approx(0.7 / 0.3)
    assert columns["zoom_ratios"]["coarse"] == pytest.approx(1.0)
    assert columns["reasoning"][NO_ZOOM]["completed"] == pytest.approx(2 / 3)


def test_a_goal_out_of_reach_is_counted_beside_what_was_achieved() -> None:
    records = [_level("a", ZOOM), _level("b", ZOOM, achieved=False, in_reach=False)]
    records.append(_level("c", ZOOM, achieved=False, in_reach=True))
    assert _columns(*records)["reasoning"][ZOOM]["out_of_reach"] == 1
    assert level_rows(summarise(records))[0][2] == "1/3, 1 out of reach"


def test_the_table_has_the_published_figures_beside_ours() -> None:
    rows = level_rows(summarise([_level("a", ZOOM), _level("a", NO_ZOOM)]))
    assert [row[:3] for row in rows] == [
        ("L3", "zoom", "1/1"),
        ("L3", "  published", "100 %"),
        ("L3", "no zoom", "1/1"),
        ("L3", "  published", "65 %"),
        ("L3", "no zoom / zoom", ""),
        ("L3", "  published", ""),
    ]
    assert all(len(row) == len(LEVEL_COLUMNS) for row in rows)
    assert rows[1][3:] == ("11.59 ± 3.88 s", "4.19 ± 1.48 s", "7.40 ± 2.57 s", "560.0 ± 50.0 ms")
    assert rows[0][3] == "1.00 ± 0.00 s"
    assert rows[5][3:] == ("20.07", "55.23", "1.00", "83.49")


def test_totals_of_the_published_figures_are_the_sums_of_their_parts() -> None:
    for (level, condition), figures in PUBLISHED.items():
        if figures.seconds:
            mean = {part: figures.seconds[part][0] for part in PARTS}
            # The published values are rounded to a hundredth each.
            assert mean["fine"] + mean["coarse"] == pytest.approx(mean["total"], abs=0.011), level
        else:
            assert (condition, figures.completed) == (NO_ZOOM, 0.0)
    assert set(RATIOS) == {"L1", "L2", "L3"}


def test_rows_are_by_level_and_a_run_without_levels_has_no_such_table() -> None:
    rows = rows_of([_level("a", ZOOM)])
    assert headings(rows)[0] == "level"
    assert rows[0].cells()[:2] == ("L3", ZOOM)
    coarse = [a_record("a")]
    assert headings(rows_of(coarse))[0] == "scenario"
    assert level_rows(summarise(coarse)) == []
