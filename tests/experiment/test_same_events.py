"""The robots of a pair at the levels meet the same, as long as they act alike."""

from collections.abc import Iterator
from itertools import groupby, takewhile

import pytest

from testbed.config import load_config
from testbed.experiment.plan import plan_trials
from testbed.experiment.robots import make_robot
from testbed.experiment.specs import TrialSpec
from testbed.experiment.storyteller import Moment
from testbed.experiment.trial import play_trial
from testbed.link import InProcessRobot

BUSY = ["levels=[L1,L2,L3]", "limit=6", "adversary.rate=0.5"]
Pair = tuple[list[Moment], list[Moment]]


def _specs() -> Iterator[list[TrialSpec]]:
    trials = plan_trials(load_config("levels", BUSY))
    return (list(pair) for _, pair in groupby(trials, lambda spec: spec.pair))


@pytest.fixture(scope="module")
def pairs() -> list[Pair]:
    """Every step of both trials of each pair, in a world in which others are busy."""
    robot = InProcessRobot(make_robot)

    def moments(spec: TrialSpec) -> list[Moment]:
        seen: list[Moment] = []
        assert play_trial(spec, robot, watch=seen.append).record.outcome == "achieved"
        return seen

    return [(moments(one), moments(other)) for one, other in _specs()]


def _alike(pair: Pair) -> list[tuple[Moment, Moment]]:
    """The steps up to the first at which the robots of a pair do something else."""
    both = zip(*pair, strict=False)
    return list(takewhile(lambda now: now[0].decision.action == now[1].decision.action, both))


def test_a_pair_has_one_start_one_goal_and_one_seed() -> None:
    pairs = list(_specs())
    assert len(pairs) == 3 * 6
    for one, other in pairs:
        assert {one.robot, other.robot} == {"intentional", "intentional-nozoom"}
        assert one.initial == other.initial
        assert one.setting == other.setting
        assert (one.level, one.seed) == (other.level, other.seed)


def test_robots_that_act_alike_meet_the_same(pairs: list[Pair]) -> None:
    """Events, what comes of the robot's own action, what it sees, and the state of the world."""
    for pair in pairs:
        alike = _alike(pair)
        assert alike, "both wait at first"
        for one, other in alike:
            assert one.event == other.event
            assert one.happened == other.happened
            assert (one.before, one.after) == (other.before, other.after)
            assert one.percept.visible == other.percept.visible


def test_there_is_something_that_they_could_meet(pairs: list[Pair]) -> None:
    together = [one for pair in pairs for one, _ in _alike(pair)]
    events = [moment.event for moment in together if moment.event is not None]
    assert len(events) > 100
    assert len(set(events)) > 10
    assert any(moment.happened is False for moment in together)
