"""Which scenario a trial came to be: the published stories, and what is beside them."""

from functools import lru_cache

import pytest

from asp.language import Literal
from testbed.analysis.comparison import Apart
from testbed.config import load_config
from testbed.experiment.plan import plan_trials
from testbed.experiment.record import Activity, At, Attempt, Occurrence, TrialRecord
from testbed.experiment.robots import make_robot
from testbed.experiment.storyteller import Moment
from testbed.experiment.trial import play_trial
from testbed.link import InProcessRobot
from testbed.studies.table1.pairs import UNCLASSIFIED, classify, state_at
from testbed.world import load_world
from tests.experiment.samples import a_record
from tests.literals import parsed

WORLD = load_world("office")
START = ["loc(rob1,kitchen)", "in_hand(rob1,book1)", "loc(book1,kitchen)", "loc(book2,office2)"]
PLAN = ["move(rob1,office2)", "move(rob1,office1)"]


@lru_cache
def _told(scenario: str) -> tuple[TrialRecord, tuple[Moment, ...]]:
    overrides = [f"scenarios=[{scenario}]", "robots=[intentional]", "link=inprocess"]
    (spec,) = plan_trials(load_config("quickstart", overrides))
    moments: list[Moment] = []
    record = play_trial(spec, InProcessRobot(make_robot), moments.append).record
    return record, tuple(moments)


@pytest.mark.parametrize("scenario", ["1", "2", "3", "4", "5", "6"])
def test_each_published_story_is_its_own_scenario(scenario: str) -> None:
    assert classify(_told(scenario)[0], WORLD) == scenario


@pytest.mark.parametrize("scenario", ["2", "3", "5", "6"])
def test_the_states_of_a_trial_follow_from_its_record(scenario: str) -> None:
    record, moments = _told(scenario)
    for moment in moments:
        assert state_at(record, WORLD, moment.percept.step) == moment.before
    assert state_at(record, WORLD, record.steps + 1) == moments[-1].after


def _record(
    executed: int, stop: int | None, event: str | None = None, **values: object
) -> TrialRecord:
    """A trial that starts an activity of two actions at step 1."""
    given: dict[str, object] = {
        "initial": START,
        "steps": 4,
        "activities": [Activity(1, 1, PLAN, stop)],
        "actions": [Attempt(2 + n, action, True) for n, action in enumerate(PLAN[:executed])],
        "exogenous": [] if event is None else [Occurrence(2, Literal.parse(event), False)],
        "mental": [At(1, Literal.parse("start(1)"))],
    }
    return a_record(**given | values)


@pytest.mark.parametrize(
    ("record", "scenario"),
    [
        (_record(2, None), "1"),
        (_record(2, None, achieved=False), "1"),
        (_record(1, None, "exo_move(book2,library)"), "2"),
        (_record(1, None, "exo_move(book2,library)", achieved=False), UNCLASSIFIED),
        (_record(2, 4, "exo_move(book2,library)"), "5"),
        (_record(1, 3, "exo_move(book2,library)"), "3"),
        (_record(1, 3, "exo_lock(library)"), "6"),
        (_record(1, 3), UNCLASSIFIED),
        (_record(0, None, activities=[]), Apart.NOTHING_TO_DO),
        (_record(0, None, activities=[], achieved=False), UNCLASSIFIED),
        (_record(1, None, activities=[]), UNCLASSIFIED),
    ],
)
def test_the_rule_case_by_case(record: TrialRecord, scenario: str) -> None:
    assert classify(record, WORLD) == scenario


def test_a_moved_book_must_be_seen_where_it_now_is() -> None:
    elsewhere = parsed([*START[:3], "loc(book2,library)"])
    seen = _record(1, 3, "exo_move(book2,office2)", initial=elsewhere)
    unseen = _record(1, 3, "exo_move(book2,office1)", initial=elsewhere)
    later = _record(1, 2, "exo_move(book2,office2)", initial=elsewhere)
    assert [classify(record, WORLD) for record in (seen, unseen, later)] == ["4", "3", "3"]
