"""A robot of another process that cannot explain what it sees stops, and plays the next trial."""

import msgspec
import pytest

from testbed.experiment.plan import plan_trials
from testbed.experiment.specs import TrialSpec
from testbed.experiment.trial import play_trial
from testbed.link import spawned_robot
from testbed.protocol import Decision, Percept, RobotClient, Task
from tests.experiment.samples import Configure

pytestmark = pytest.mark.load

PATIENCE_S = 600.0
# Nobody unlocks a room but the robot.
LOCKED, UNLOCKED = "locked(library)", "-locked(library)"


class Misled:
    """A client whose robot sees, from step 2 on, that a lock is open which it saw locked."""

    def __init__(self, client: RobotClient) -> None:
        self._client = client

    def begin(self, task: Task) -> None:
        self._client.begin(task)

    def ask(self, percept: Percept) -> Decision:
        if percept.step >= 2:
            assert LOCKED in percept.visible
            seen = [UNLOCKED if literal == LOCKED else literal for literal in percept.visible]
            percept = msgspec.structs.replace(percept, visible=seen)
        return self._client.ask(percept)

    def close(self) -> None:
        self._client.close()


def _spec(configure: Configure, robot: str) -> TrialSpec:
    initial = f'["loc(rob1,kitchen)","loc(book1,kitchen)","loc(book2,kitchen)","{LOCKED}"]'
    (spec,) = plan_trials(
        configure(
            "scenarios=[1]",
            f"robots=[{robot}]",
            "scenario_settings={}",
            "script=[]",
            "limits={plan: 8, decision_s: null}",
            f"initial={initial}",
            f'goal=["{UNLOCKED}"]',
        )
    )
    return spec


@pytest.mark.parametrize(
    "kind", ["intentional", "intentional-plain", "intentional-joint", "intentional-joint-staged"]
)
def test_an_inconsistent_history_ends_the_trial_and_not_the_process(
    configure: Configure, kind: str
) -> None:
    spec = _spec(configure, kind)
    with spawned_robot("run", PATIENCE_S) as robot:
        result = play_trial(spec, Misled(robot))
        assert robot.process is not None
        served_by = robot.process.pid
        assert (result.record.outcome, result.details) == ("error", None)
        assert result.record.reason == (
            f"inconsistent history: obs({LOCKED}) at 1 and obs({UNLOCKED}) at 2 cannot both hold"
        )
        again = play_trial(spec, robot).record
        assert again.outcome == "achieved"
        assert robot.process is not None
        assert robot.process.pid == served_by
