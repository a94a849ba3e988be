"""Trials of the published scenarios with a robot whose answers are timed."""

import time
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from functools import partial

from agents.intentional import IntentionalRobot
from agents.intentional.reasoners import ReferenceReasoner
from testbed.config import load_config
from testbed.experiment.plan import plan_trials
from testbed.experiment.specs import TrialSpec
from testbed.experiment.trial import play_trial
from testbed.link import InProcessRobot
from testbed.protocol import Decision, Percept, Robot, Task

SCENARIOS = ("1", "2", "3", "4", "5", "6")
ROBOTS: Mapping[str, Callable[[], Robot]] = {
    "fast": IntentionalRobot,
    "reference": partial(IntentionalRobot, ReferenceReasoner),
}


@dataclass
class Played:
    """What a robot's part in a trial took (ms), and what it decided."""

    begin_ms: float = 0.0
    decisions_ms: list[float] = field(default_factory=list)
    decisions: list[Decision] = field(default_factory=list)

    @property
    def whole_ms(self) -> float:
        return self.begin_ms + sum(self.decisions_ms)

    @property
    def answers(self) -> list[tuple[object, ...]]:
        """Intention, plan and adopted explanation of each decision."""
        return [
            (d.trace.intention, *d.trace.plan, str(d.trace.explanation)) for d in self.decisions
        ]


class Timed:
    """A robot with a clock."""

    def __init__(self, robot: Robot, played: Played) -> None:
        self._robot = robot
        self._played = played

    def begin(self, task: Task) -> None:
        began = time.perf_counter()
        self._robot.begin(task)
        self._played.begin_ms = (time.perf_counter() - began) * 1e3

    def act(self, percept: Percept) -> Decision:
        began = time.perf_counter()
        decision = self._robot.act(percept)
        self._played.decisions_ms.append((time.perf_counter() - began) * 1e3)
        self._played.decisions.append(decision)
        return decision


def specs(scenario: str, number: int) -> list[TrialSpec]:
    """Trials of a scenario from `number` initial states, with its triggers' events."""
    overrides = ["robots=[intentional]", f"scenarios=['{scenario}']", f"limit={number}"]
    return plan_trials(load_config("office", overrides))


def play(spec: TrialSpec, side: str) -> Played:
    """One trial. Raises RuntimeError if it failed."""
    played = Played()
    client = InProcessRobot(lambda _: Timed(ROBOTS[side](), played))
    result = play_trial(spec, client)
    if result.details is not None:
        raise RuntimeError(result.details)
    return played
