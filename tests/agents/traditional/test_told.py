"""The baseline replans where its action fails, also where the cause was reported to it."""

from testbed.config import load_config
from testbed.experiment.plan import plan_trials
from testbed.experiment.robots import make_robot
from testbed.experiment.trial import play_trial
from testbed.link import InProcessRobot


def test_a_reported_lock_makes_it_plan_anew() -> None:
    told = ["scenarios=[6]", "robots=[traditional]", "observability.exo_lock.mode=always"]
    (spec,) = plan_trials(load_config("quickstart", told))
    record = play_trial(spec, InProcessRobot(make_robot)).record
    assert [event.observed for event in record.exogenous] == [True]
    assert (record.outcome, record.plans) == ("achieved", 2)
    assert "unlock(rob1,library)" in [attempt.action for attempt in record.actions]
