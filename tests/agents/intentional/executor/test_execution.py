"""Abstract actions carried out in a world with injected faults."""

from functools import cache, partial
from importlib.resources import files
from typing import Any

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from agents.intentional import IntentionalRobot
from agents.intentional.executor import zoomed_planning
from agents.intentional.executor.belief import FineTracker
from agents.intentional.refined import RefinedRobot
from asp.domains import level_text
from asp.language import read_domain
from asp.refinement import Refinement, load
from asp.solving import LimitError
from testbed.protocol import Task
from tests.agents.intentional.executor.faulty_world import NO_FAULTS, TEXTS, Faults, Play, play
from tests.literals import parsed

LATE = "the time ran out"

GOAL = parsed(["loc(object1,room2)", "-in_hand(rob1,object1)"])


@cache
def _level(rooms: int, cells: int, objects: tuple[tuple[int, int], ...]) -> Refinement:
    coarse, fine = level_text(rooms, 1, cells, objects)
    refinement = load(coarse, "faulty.al", fine, "faulty.fine")
    TEXTS[refinement] = fine
    return refinement


ROW = partial(_level, 3, 4, ((2, 2),))
ONE_ROOM_AWAY = parsed(
    ["fine_loc(rob1,room1_1)", "fine_loc(object1_1,room1_3)", "fine_loc(object2_1,room3_4)"]
)


@cache
def _office() -> Refinement:
    coarse = read_domain("office")[1]
    fine = files("asp").joinpath("domains", "office.fine").read_text(encoding="utf-8")
    refinement = load(coarse, "faulty.al", fine, "faulty.fine")
    TEXTS[refinement] = fine
    return refinement


def carried_out(faults: Faults = NO_FAULTS, zooms: bool = True) -> Play:
    return play(RefinedRobot(IntentionalRobot(), zooms), ROW(), ONE_ROOM_AWAY, GOAL, faults)


def look(cell: str, thing: str = "object1_1") -> str:
    return f"test_fine_loc(rob1,{thing},{cell})"


FOUND = [
    "fine_move(rob1,room1_2)",
    "fine_move(rob1,room1_3)",
    "fine_pickup(rob1,object1_1)",
    "fine_move(rob1,room1_4)",
    "fine_move(rob1,room2_1)",
    "fine_put_down(rob1,object1_1)",
]
TASK_DONE = [
    ("pickup(rob1,object1)", True),
    ("move(rob1,room2)", True),
    ("put_down(rob1,object1)", True),
]


@pytest.mark.parametrize("zooms", [True, False])
def test_without_faults_the_nearest_cells_are_searched(zooms: bool) -> None:
    went = carried_out(zooms=zooms)
    assert went.achieved
    assert went.actions == FOUND
    assert went.abstract == TASK_DONE


def test_every_outcome_is_tested_at_once() -> None:
    went = carried_out()
    following = zip(went.decisions, went.decisions[1:], strict=False)
    pairs = [(one.action, two.action) for one, two in following if one.action in FOUND]
    assert len(pairs) == len(FOUND)
    for action, test in pairs:
        inside = action.partition("(")[2].rstrip(")")
        moved = action.startswith("fine_move")
        expected = f"test_fine_loc(rob1,{inside})" if moved else f"test_fine_in_hand({inside})"
        assert test == expected


def test_nothing_is_picked_up_that_was_not_found_there() -> None:
    went = carried_out()
    known: list[str] = []
    for decision in went.decisions:
        assert decision.trace.fine is not None
        known += decision.trace.fine.committed
        if decision.action.startswith("fine_pickup"):
            assert "fine_loc(object1_1,room1_3)" in known


def test_only_what_is_relevant_is_looked_for() -> None:
    went = carried_out()
    assert not [d.action for d in went.decisions if "object2" in d.action]
    begun = [trace.zoomed for trace in went.fine if trace.begun is not None and trace.zoomed]
    assert begun[0] == ["object1", "rob1", "room1", "room2"]


def test_a_slip_is_noticed_and_repeated() -> None:
    went = carried_out(Faults(slips=[(FOUND[0], 1), (FOUND[4], 1), (FOUND[4], 2)]))
    assert went.achieved
    assert went.abstract == TASK_DONE
    assert went.actions == [FOUND[0], *FOUND[:4], FOUND[4], FOUND[4], *FOUND[4:]]
    failed = [trace.failed for trace in went.fine if trace.failed]
    assert failed[0] == "fine_move(rob1,room1_2): not fine_loc(rob1,room1_2)"
    slips, empty_cells_on_the_way = 3, 1
    assert went.fine[-1].plans == len(TASK_DONE) + slips + empty_cells_on_the_way


def test_a_false_positive_is_found_out_and_repaired() -> None:
    went = carried_out(Faults(lies=[(look("room1_2"), 1)]))
    assert went.achieved
    assert went.abstract == TASK_DONE
    wrong = "fine_loc(object1_1,room1_2)"
    assert went.committed.index(wrong) < went.committed.index(f"-{wrong}")
    assert went.actions == [FOUND[0], FOUND[2], *FOUND[1:]]


def test_absence_is_tested_twice() -> None:
    went = carried_out(Faults(lies=[(look("room1_3"), 1)]))
    assert went.actions == FOUND
    assert "-fine_loc(object1_1,room1_3)" not in went.committed


def test_an_exhausted_room_leaves_the_rest_to_the_coarse_resolution() -> None:
    lies = [(look("room1_3"), 1), (look("room1_3"), 2)]
    went = carried_out(Faults(lies=lies))
    assert went.achieved
    assert went.abstract[0] == ("pickup(rob1,object1)", False)
    ended = next(trace for trace in went.fine if trace.ended)
    assert "-loc(object1,room1)" in ended.inferred
    explained = [d.trace.explanation for d in went.decisions if d.trace.explanation is not None]
    assert explained[0].unobserved[0].action.startswith("exo_move(object1,")


def test_an_object_that_is_taken_away_is_looked_for_elsewhere() -> None:
    away = {(FOUND[0], 1): "fine_exo_move(object1_1,room3_1)"}
    went = carried_out(Faults(events=away))
    assert went.achieved
    assert went.abstract[0] == ("pickup(rob1,object1)", False)


def test_where_that_is_reported_the_search_ends() -> None:
    away = {(FOUND[0], 1): "fine_exo_move(object1_1,room3_1)"}
    went = carried_out(Faults(events=away, reported=True))
    assert went.achieved
    assert went.abstract[0] == ("pickup(rob1,object1)", False)
    over = next(n for n, trace in enumerate(went.fine) if trace.ended)
    searched = [decision.action for decision in went.decisions[:over]]
    assert look("room1_3") not in searched
    assert look("room1_4") not in searched


def test_a_move_within_the_room_is_no_event_of_the_coarse_history() -> None:
    within = {(FOUND[0], 1): "fine_exo_move(object1_1,room1_4)"}
    went = carried_out(Faults(events=within, reported=True))
    assert went.achieved
    assert went.abstract == TASK_DONE
    assert "fine_pickup(rob1,object1_1)" in went.actions
    assert not any(d.trace.explanation for d in went.decisions)


def test_what_is_seen_on_the_way_changes_the_plan() -> None:
    start = parsed(
        ["fine_loc(rob1,room1_1)", "fine_loc(object1_1,room3_4)", "fine_loc(object2_1,room3_4)"]
    )
    goal = parsed(["loc(object1,room1)"])
    brought = {("fine_move(rob1,room1_3)", 1): "fine_exo_move(object1_1,room2_1)"}
    went = play(RefinedRobot(IntentionalRobot()), ROW(), start, goal, Faults(events=brought))
    assert went.achieved
    assert "fine_pickup(rob1,object1_1)" in went.actions
    assert not [a for a in went.actions if "room3" in a]


def test_a_goal_that_was_undone_is_explained() -> None:
    undone = {("test_fine_in_hand(rob1,object1_1)", 2): "fine_exo_move(object1_1,room3_2)"}
    went = carried_out(Faults(events=undone))
    assert went.achieved
    assert [p.goal_holds for p in went.percepts].count(False) == 1


IN_OFFICE = parsed(["fine_loc(book1_cover,office1_1)", "fine_loc(book2_cover,office1_2)"])


@pytest.mark.parametrize("zooms", [True, False])
def test_a_room_that_is_locked_with_the_robot_inside(zooms: bool) -> None:
    start = [*IN_OFFICE, "fine_loc(rob1,library_1)"]
    locked = {("fine_move(rob1,library_3)", 1): "exo_lock(library)"}
    went = play(
        RefinedRobot(IntentionalRobot(), zooms),
        _office(),
        start,
        parsed(["loc(rob1,office2)"]),
        Faults(events=locked),
    )
    assert went.achieved
    assert "unlock(rob1,library)" in went.actions


@pytest.mark.parametrize("reported", [True, False])
def test_a_room_that_is_locked_before_the_robot_is_in(reported: bool) -> None:
    start = [*IN_OFFICE, "fine_loc(rob1,kitchen_1)"]
    locked = {("fine_move(rob1,kitchen_2)", 1): "exo_lock(library)"}
    faults = Faults(events=locked, reported=reported)
    went = play(
        RefinedRobot(IntentionalRobot()), _office(), start, parsed(["loc(rob1,library)"]), faults
    )
    assert went.achieved
    assert "unlock(rob1,library)" in went.actions


CELLS = [f"room{room}_{cell}" for room in (1, 2, 3) for cell in (1, 2, 3, 4)]
STARTS = st.tuples(*(st.sampled_from(CELLS) for _ in range(3)))
LIES = st.sets(
    st.tuples(st.sampled_from([look(cell) for cell in CELLS]), st.integers(1, 4)), max_size=6
)


@given(STARTS, LIES)
@settings(max_examples=40)
def test_no_cell_is_searched_twice_unless_something_changed(
    places: tuple[str, str, str], lies: set[tuple[str, int]]
) -> None:
    things = ("rob1", "object1_1", "object2_1")
    start = parsed(
        [f"fine_loc({thing},{cell})" for thing, cell in zip(things, places, strict=True)]
    )
    went = play(RefinedRobot(IntentionalRobot()), ROW(), start, GOAL, Faults(lies=lies))
    assert went.achieved
    searched: set[str] = set()
    for decision in went.decisions:
        assert decision.trace.fine is not None
        if decision.trace.explanation is not None:
            searched.clear()
        absent = [c for c in decision.trace.fine.committed if c.startswith("-fine_loc(object1")]
        assert searched.isdisjoint(absent)
        searched.update(absent)


@pytest.mark.parametrize("reported", [True, False])
def test_what_is_put_down_may_be_taken_away_at_once(reported: bool) -> None:
    start = parsed(["fine_loc(rob1,room2_1)", "fine_loc(object1_1,room2_1)"])
    start += parsed(["fine_in_hand(rob1,object1_2)", "fine_loc(object2_1,room3_4)"])
    taken = {("test_fine_in_hand(rob1,object1_2)", 1): "fine_exo_move(object1_1,room3_2)"}
    went = play(
        RefinedRobot(IntentionalRobot()),
        ROW(),
        start,
        GOAL,
        Faults(events=taken, reported=reported),
    )
    assert went.achieved
    assert "fine_pickup(rob1,object1_1)" in went.actions


def _fine() -> FineTracker:
    """That of a robot which knows its own cell and nothing else."""
    robot = RefinedRobot(IntentionalRobot())
    task = Task(
        trial="play",
        robot="rob1",
        domain="faulty",
        source=ROW().coarse.text,
        refinement=TEXTS[ROW()],
        goal=GOAL,
        initial=parsed(["loc(rob1,room1)"]),
        initial_fine=parsed(["fine_loc(rob1,room1_1)"]),
        plan_limit=20,
        seed=0,
    )
    robot.begin(task)
    return robot._fine


def test_which_part_it_holds_is_nothing_to_assume_in_a_plan() -> None:
    held = parsed(["fine_in_hand(rob1,object1_1)", "fine_in_hand(rob1,object1_2)"])
    zoom = ["rob1", "object1", "room1"]
    assert (
        zoomed_planning.shortest_plan(_fine(), parsed(["-in_hand(rob1,object1)"]), (held,), zoom)
        is None
    )


def test_what_is_wrong_with_a_plan_is_not_taken_for_none() -> None:
    with pytest.raises(ValueError, match="room3"):
        zoomed_planning.shortest_plan(
            _fine(), parsed(["loc(rob1,room3)"]), (), ["rob1", "room1", "room2"]
        )


def test_where_the_time_runs_out_it_waits_and_goes_on(monkeypatch: pytest.MonkeyPatch) -> None:
    planned = zoomed_planning.shortest_plan
    calls: list[int] = []

    def slow(*given: Any) -> tuple[str, ...] | None:
        calls.append(len(calls))
        if len(calls) == 2:
            raise LimitError(LATE)
        return planned(*given)

    monkeypatch.setattr(zoomed_planning, "shortest_plan", slow)
    went = carried_out()
    assert went.achieved
    assert went.actions == FOUND
    assert [trace.failed for trace in went.fine].count(LATE) == 1
