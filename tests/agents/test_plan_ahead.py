"""`Trace.plan` is what is still ahead, at each step, of each robot."""

from pathlib import Path

import pytest

from testbed.config import load_config
from testbed.experiment.plan import plan_trials
from testbed.experiment.robots import make_robot
from testbed.experiment.storyteller import Moment
from testbed.experiment.trial import play_trial
from testbed.link import InProcessRobot

GARDEN = """
sorts
  bed   = {north, south, west}.
  robot = {ida}.
fluents
  inertial watered(bed).
actions
  agent     water(robot, bed).
  exogenous dry_out(bed).
laws
  water(R, B) causes watered(B).
  dry_out(B) causes -watered(B).
  impossible dry_out(B) if -watered(B).
sees
  R sees watered(B) if robot(R).
scenarios
  quiet: nothing.
"""
ROBOTS = (
    "intentional",
    "intentional-plain",
    "intentional-joint",
    "intentional-joint-staged",
    "traditional",
)


def _played(path: Path, robot: str, script: str) -> list[Moment]:
    path.write_text(GARDEN, encoding="utf-8")
    overrides = [
        f"domain={path}",
        "goal=[watered(north),watered(south),watered(west)]",
        "initial=[-watered(north),-watered(south),-watered(west)]",
        "scenarios=[quiet]",
        "observability={}",
        f"script={script}",
        f"robots=[{robot}]",
        "link=inprocess",
        "limits={plan: 8, decision_s: null}",
    ]
    (spec,) = plan_trials(load_config("office", overrides))
    moments: list[Moment] = []
    record = play_trial(spec, InProcessRobot(make_robot), watch=moments.append).record
    assert record.outcome == "achieved"
    assert record.activities[0].plan == moments[0].decision.trace.plan
    return moments


@pytest.mark.parametrize("robot", ROBOTS)
def test_the_plan_of_a_step_is_what_is_done_from_there_on(tmp_path: Path, robot: str) -> None:
    moments = _played(tmp_path / "garden.al", robot, "[]")
    actions = [moment.decision.action for moment in moments]
    done = [action for action in actions if action.startswith("water")]
    assert len(done) == 3
    for number, moment in enumerate(moments):
        ahead = [action for action in actions[number:] if action in done]
        assert moment.decision.trace.plan == ahead


@pytest.mark.parametrize("robot", [name for name in ROBOTS if name.startswith("intentional")])
def test_nothing_is_ahead_of_an_activity_that_is_stopped(tmp_path: Path, robot: str) -> None:
    script = "[{step: 4, action: dry_out(north)}]"
    moments = _played(tmp_path / "garden.al", robot, script)
    traces = [moment.decision.trace for moment in moments]
    stopped = [trace for trace in traces if (trace.mental or "").startswith("stop")]
    assert len(stopped) == 1
    assert stopped[0].plan == []
    for moment in moments:
        if moment.decision.action.startswith("water"):
            assert moment.decision.trace.plan[0] == moment.decision.action
