"""What configurations are told of the robots, against the robots."""

import pytest

from testbed.experiment.plan import plan_trials
from testbed.experiment.robots import HUMAN, ROBOTS, make_robot
from testbed.experiment.trial import play_trial
from testbed.link import InProcessRobot
from tests.experiment.samples import Configure

LIMITS = ("limits.plan=8", "limits.decision_s=null")
EVENT = "script=[{step: 1, action: 'exo_lock(library)'}]"


COARSE = {
    name: robot.capabilities
    for name, robot in ROBOTS.usable()
    if "coarse" in robot.capabilities.resolutions and name != HUMAN
}


@pytest.mark.parametrize("robot", COARSE)
@pytest.mark.parametrize("goal", ["loc(rob1,office1)", "loc(rob1,kitchen)"])
def test_an_event_at_step_1_is_an_error_beside_those_that_only_start(
    configure: Configure, robot: str, goal: str
) -> None:
    config = configure("scenarios=[1]", f"goal=[{goal}]", f"robots=[{robot}]", EVENT, *LIMITS)
    (spec,) = plan_trials(config)
    outcome = play_trial(spec, InProcessRobot(lambda _: make_robot(robot))).record.outcome
    nothing_to_do = goal == "loc(rob1,kitchen)"  # then whoever it is finishes at once
    assert (outcome == "error") == (COARSE[robot].first_action_step > 1 or nothing_to_do)
