"""The quickstart's six scenarios, played as told, in process and over zenoh."""

from collections.abc import Callable
from pathlib import Path

import pytest

from testbed.config import load_config
from testbed.experiment.record import Activity, TrialRecord
from testbed.experiment.runner import play_missing
from testbed.experiment.store import read_records

Play = Callable[..., list[TrialRecord]]
Told = dict[tuple[str, str], TrialRecord]
PUBLISHED = [
    "move(rob1,library)",
    "put_down(rob1,book1)",
    "move(rob1,kitchen)",
    "pickup(rob1,book2)",
    "move(rob1,library)",
    "put_down(rob1,book2)",
]


@pytest.fixture(scope="module", params=["inprocess", "zenoh"])
def told(request: pytest.FixtureRequest, tmp_path_factory: pytest.TempPathFactory) -> Told:
    folder: Path = tmp_path_factory.mktemp(request.param)
    config = load_config("quickstart", [f"link={request.param}"])
    play_missing(config, folder, 1, lambda _: None)
    return {(record.scenario, record.robot): record for record in read_records(folder)}


@pytest.fixture(params=["inprocess", "zenoh"])
def play(request: pytest.FixtureRequest, tmp_path_factory: pytest.TempPathFactory) -> Play:
    """Plays the quickstart with other settings: the intentional robot's records."""

    def played(*overrides: str) -> list[TrialRecord]:
        folder: Path = tmp_path_factory.mktemp(request.param)
        always = [f"link={request.param}", "robots=[intentional]"]
        play_missing(load_config("quickstart", [*always, *overrides]), folder, 1, lambda _: None)
        return list(read_records(folder))

    return played


def _ati(told: Told, scenario: str) -> TrialRecord:
    return told[scenario, "intentional"]


def _actions(record: TrialRecord) -> list[str]:
    return [attempt.action for attempt in record.actions]


def _explained(record: TrialRecord) -> list[tuple[int, str]]:
    return [(e.step, e.action) for item in record.explanations for e in item.unobserved]


def _happened(record: TrialRecord) -> list[tuple[int, str]]:
    return [(event.step, event.action) for event in record.exogenous]


def _two_activities(record: TrialRecord) -> tuple[Activity, Activity]:
    first, second = record.activities
    return first, second


def test_every_scenario_is_played_by_both_robots(told: Told) -> None:
    assert set(told) == {(s, r) for s in "123456" for r in ("intentional", "traditional")}
    assert not [record.reason for record in told.values() if record.reason]


def test_the_intentional_robot_achieves_every_goal(told: Told) -> None:
    for scenario in "123456":
        record = _ati(told, scenario)
        assert (record.outcome, record.correct) == ("achieved", True)


def test_1_the_plan_is_the_published_one(told: Told) -> None:
    record = _ati(told, "1")
    assert _actions(record) == PUBLISHED
    assert [(m.step, m.action) for m in record.mental] == [(1, "start(1)"), (8, "finish")]
    assert (record.plans, record.minimal_actions, record.execution_units) == (1, 6, 60)
    assert _happened(record) == _explained(record) == []


def test_2_the_robot_finishes_without_fetching_the_other_book(told: Told) -> None:
    record = _ati(told, "2")
    assert _happened(record) == [(3, "exo_move(book2,library)")]
    assert _explained(record) == [(3, "exo_move(book2,library)")]
    assert _actions(record) == PUBLISHED[:2]
    assert record.plans == 1
    assert told["2", "traditional"].action_count > 2


@pytest.mark.parametrize(
    ("scenario", "change"), [("3", "exo_move(book2,office1)"), ("4", "exo_move(book2,kitchen)")]
)
def test_3_and_4_the_first_activity_stops_where_the_change_is_seen(
    told: Told, scenario: str, change: str
) -> None:
    record = _ati(told, scenario)
    assert _happened(record) == [(1, change)]
    first, second = _two_activities(record)
    assert (first.start, first.stop) == (1, 2)  # seen at step 2, before its first move
    assert [explanation.step for explanation in record.explanations] == [2]
    ((_, explained),) = _explained(record)
    assert explained.startswith("exo_move(book2,")
    assert (second.start, second.stop) == (3, None)
    assert _actions(record)[-2:] == ["move(rob1,library)", "put_down(rob1,book2)"]


def test_4_the_plan_that_would_have_gone_far_is_given_up_for_the_near_book(told: Told) -> None:
    first, second = _two_activities(_ati(told, "4"))
    assert len(first.plan) == 10
    assert second.plan == _actions(_ati(told, "4")) == PUBLISHED


def _stops_where_it_sees(record: TrialRecord) -> None:
    """The first activity ends one step after the change, for one event, and all ends well."""
    ((changed, event),) = _happened(record)
    seen = changed + 1
    assert (record.activities[0].start, record.activities[0].stop) == (1, seen)
    assert record.explanations[0].step == seen
    ((when, first),) = [(e.step, e.action) for e in record.explanations[0].unobserved]
    assert when == changed
    assert first.arguments[0] == event.arguments[0]
    # Whatever it assumed at first, what it believes in the end is what happened.
    assert [(e.step, e.action) for e in record.explanations[-1].unobserved] == [(changed, event)]
    assert (record.outcome, record.correct) == ("achieved", True)


@pytest.mark.parametrize(
    ("room", "activities", "fetched"),
    [("office1", 2, True), ("office2", 3, True), ("library", 2, False)],
)
def test_3_wherever_the_book_went_the_robot_stops_at_once(
    play: Play, room: str, activities: int, fetched: bool
) -> None:
    script = f"scenario_settings.3.script=[{{step: 1, action: 'exo_move(book2,{room})'}}]"
    (record,) = play("scenarios=[3]", script)
    _stops_where_it_sees(record)
    assert len(record.activities) == activities  # office1 is where it looks first
    assert ("pickup(rob1,book2)" in _actions(record)) == fetched


def test_4_the_book_may_have_been_anywhere(play: Play) -> None:
    initial = "[loc(rob1,kitchen),in_hand(rob1,book1),loc(book2,office2)]"
    (record,) = play("scenarios=[4]", f"scenario_settings.4.initial={initial}")
    _stops_where_it_sees(record)
    first, second = _two_activities(record)
    assert len(first.plan) == 8
    assert second.plan == _actions(record) == PUBLISHED


@pytest.mark.parametrize("scenario", ["3", "4"])
def test_3_and_4_played_by_the_domains_trigger(play: Play, scenario: str) -> None:
    own = f"scenario_settings.{scenario}"
    by_trigger = [f"{own}.script=null", f"{own}.exogenous_while_thinking=false"]
    played = play(f"scenarios=[{scenario}]", "repeats=12", *by_trigger)
    fired = [record for record in played if record.exogenous]
    assert len({event for record in fired for _, event in _happened(record)}) > 1
    for record in fired:
        assert _happened(record)[0][0] == 4  # while the robot comes back for book2
        _stops_where_it_sees(record)


def test_5_a_goal_that_is_false_at_the_end_is_explained_and_achieved(told: Told) -> None:
    record = _ati(told, "5")
    assert _happened(record) == [(7, "exo_move(book1,kitchen)")]
    first, second = _two_activities(record)
    assert first.plan == PUBLISHED
    assert first.stop == 8
    assert [action for _, action in _explained(record)][:1] == ["exo_move(book1,kitchen)"]
    assert "pickup(rob1,book1)" in second.plan


def test_5_the_traditional_robot_finishes_falsely(told: Told) -> None:
    record = told["5", "traditional"]
    assert (record.outcome, record.finished, record.achieved) == ("false_finish", True, False)
    assert _actions(record) == PUBLISHED


def test_6_a_failed_move_is_explained_by_the_lock(told: Told) -> None:
    record = _ati(told, "6")
    assert _happened(record) == [(1, "exo_lock(library)")]
    assert "exo_lock(library)" in [action for _, action in _explained(record)]
    assert (_actions(record)[0], record.actions[0].happened) == ("move(rob1,library)", False)
    assert "unlock(rob1,library)" in _actions(record)
    assert record.plans == 2


def test_undisturbed_every_initial_state_is_solved_with_a_shortest_plan(tmp_path: Path) -> None:
    config = load_config("office", ["scenarios=[1]", "robots=[intentional]", "link=inprocess"])
    play_missing(config, tmp_path, 2, lambda _: None)
    records = list(read_records(tmp_path))
    assert len({tuple(record.initial) for record in records}) == 192
    assert [r.trial for r in records if not (r.achieved and r.finished)] == []
    assert [r.trial for r in records if r.action_count != r.minimal_actions] == []
    assert max(record.action_count for record in records) > 10
