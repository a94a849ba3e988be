"""Where the time for a decision runs out TP waits, and goes on as if nothing had been."""

from collections.abc import Collection

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from agents.shared import Intention
from agents.traditional import TraditionalRobot
from agents.traditional.reasoners import IncrementalReasoner
from asp.reasoning import Knowledge
from asp.reasoning.diagnosis import Diagnosis, Explanation, History
from asp.solving import LimitError
from testbed.config import load_config
from testbed.experiment.plan import plan_trials
from testbed.experiment.robots import make_robot
from testbed.experiment.specs import TrialSpec
from testbed.experiment.trial import play_trial
from testbed.link import InProcessRobot
from testbed.protocol import Plans
from tests.agents.intentional.lives import BOTH_IN_THE_LIBRARY, WORLD, live
from tests.literals import parsed

LATE = "the time ran out"

START = WORLD.state(parsed(["loc(rob1,office2)", "loc(book1,kitchen)", "loc(book2,kitchen)"]))


class Hurried(IncrementalReasoner):
    """Has no time at some of its calls: neither to explain, or to plan what it has explained."""

    def __init__(
        self, hurried: Collection[int], knowledge: Knowledge, goal: tuple[str, ...], limit: int
    ) -> None:
        super().__init__(knowledge, goal, limit)
        self._hurried = hurried
        self._calls = 0
        self.out_of_time = 0

    def diagnose(self, history: History, adopted: Explanation) -> Diagnosis:
        self._hurry()
        return super().diagnose(history, adopted)

    def intend(self, history: History, diagnosis: Diagnosis, /) -> Intention:
        self._hurry()
        return super().intend(history, diagnosis)

    def _hurry(self) -> None:
        self._calls += 1
        if self._calls in self._hurried:
            self.out_of_time += 1
            raise LimitError(LATE)


class HurriedRobot(TraditionalRobot):
    """TP whose time runs out at some calls of its reasoner, the first being 1."""

    def __init__(self, *calls: int) -> None:
        super().__init__(self._make)
        self._hurried = calls

    def _make(
        self, knowledge: Knowledge, goal: tuple[str, ...], limit: int, _plans: Plans
    ) -> Hurried:
        self.planner = Hurried(self._hurried, knowledge, goal, limit)
        return self.planner


@settings(max_examples=15)
@given(calls=st.sets(st.integers(1, 12), max_size=6))
def test_it_does_what_it_would_have_done_only_later(calls: set[int]) -> None:
    robot = HurriedRobot(*calls)
    life = live(robot, START, BOTH_IN_THE_LIBRARY)
    undisturbed = live(TraditionalRobot(), START, BOTH_IN_THE_LIBRARY)
    late = [d for d in life.decisions if d.action == "wait"]
    in_time = [d for d in life.decisions if d.action != "wait"]
    assert [d.action for d in in_time] == [d.action for d in undisturbed.decisions]
    assert life.achieved
    assert len(late) == robot.planner.out_of_time
    assert all(d.trace.reason == LATE and not d.believes_goal for d in late)
    assert in_time[-1].trace.plans == 1


def _spec(*overrides: str) -> TrialSpec:
    chosen = ["robots=[traditional]", "link=inprocess", *overrides]
    (spec,) = plan_trials(load_config("quickstart", chosen))
    return spec


@pytest.mark.parametrize("call", range(3, 13))
def test_what_failed_is_not_forgotten_where_there_is_no_time_to_plan_anew(call: int) -> None:
    """A lock that it was told of stops it: nothing is left to explain, but all to plan.

    At call 3 it has just begun, so that the lock comes as it would have come.
    """
    spec = _spec("scenarios=[6]", "observability.exo_lock.mode=always")
    record, undisturbed = (
        play_trial(spec, InProcessRobot(lambda _, calls=calls: HurriedRobot(*calls))).record
        for calls in ((call,), ())
    )
    assert (record.outcome, record.plans) == ("achieved", 2)
    attempts = [[attempt.action for attempt in r.actions] for r in (record, undisturbed)]
    assert attempts[0] == attempts[1]


@pytest.mark.parametrize("robot", ["traditional", "traditional-plain"])
def test_a_trial_without_any_time_ends_and_the_next_one_is_played(robot: str) -> None:
    client = InProcessRobot(make_robot)
    chosen = ("scenarios=[1]", f"robots=[{robot}]")
    hurried = play_trial(_spec(*chosen, "limits.decision_s=1e-9", "limits.steps=5"), client).record
    assert (hurried.outcome, hurried.steps, hurried.actions) == ("step_limit", 5, [])
    assert play_trial(_spec(*chosen), client).record.outcome == "achieved"
