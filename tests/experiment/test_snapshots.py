"""Snapshots of robots that have none of their own, and of those that cannot be replayed."""

from collections.abc import Iterator
from pathlib import Path

import pytest

from testbed.experiment.robots import ROBOTS
from testbed.experiment.snapshots import SnapshotError, restorable_robot
from testbed.protocol import Percept, Task
from testbed.registry import RegistryError
from tests.literals import parsed

MODULE = """\
from testbed.protocol import Capabilities, Decision, Trace


class Counting:
    '''Waits, and finishes at its third decision, whatever the step.'''

    capabilities = Capabilities()
    made = 0

    def __init__(self):
        type(self).made += 1

    def begin(self, task):
        self.left = 2

    def act(self, percept):
        self.left -= 1
        return Decision(
            trial=percept.trial,
            step=percept.step,
            action=self.answer(),
            believes_goal=False,
            trace=Trace(),
        )

    def answer(self):
        return "wait" if self.left >= 0 else "finish"


class Moody(Counting):
    '''Decides otherwise when it is made a second time.'''

    def answer(self):
        return "wait" if Moody.made % 2 else "finish"


class Boasting(Counting):
    capabilities = Capabilities(snapshots=True)
"""
TASK = Task(
    trial="t",
    robot="Counting",
    domain="nowhere",
    source="",
    goal=[],
    initial=[],
    plan_limit=1,
    seed=0,
)


@pytest.fixture
def own(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[str]:
    (tmp_path / "robots_of_snapshots.py").write_text(MODULE, encoding="utf-8")
    monkeypatch.syspath_prepend(tmp_path)
    yield "robots_of_snapshots"
    ROBOTS.forget()


def percept(step: int) -> Percept:
    return Percept(trial="t", step=step, visible=[])


def test_a_robot_without_snapshots_is_told_the_same_again(own: str) -> None:
    robot = restorable_robot(f"{own}:Counting")
    robot.begin(TASK)
    robot.act(percept(1))
    snapshot = robot.snapshot()
    for _ in range(2):
        rest = [robot.act(percept(step)).action for step in (2, 3, 4)]
        assert rest == list(parsed(["wait", "finish", "finish"]))
        robot.restore(snapshot)


def test_one_that_then_decides_otherwise_is_refused_in_one_line(own: str) -> None:
    robot = restorable_robot(f"{own}:Moody")
    robot.begin(TASK)
    robot.act(percept(1))
    with pytest.raises(SnapshotError) as refused:
        robot.restore(robot.snapshot())
    assert "\n" not in str(refused.value)
    assert all(part in str(refused.value) for part in ("Moody", "step 1"))


def test_a_search_that_needs_snapshots_refuses_a_robot_without_any(own: str) -> None:
    with pytest.raises(SnapshotError) as refused:
        restorable_robot(f"{own}:Counting", replays=False)
    assert "\n" not in str(refused.value)
    assert "Counting" in str(refused.value)


def test_snapshots_that_are_declared_have_to_be_there(own: str) -> None:
    with pytest.raises(RegistryError, match="snapshot"):
        ROBOTS.find(f"{own}:Boasting")
