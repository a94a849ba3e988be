"""Trials that are played on from the same moment in several ways."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from random import Random
from typing import Any

from msgspec import Struct, structs

from testbed.config import load_config
from testbed.environment import Core
from testbed.experiment.plan import plan_trials
from testbed.experiment.specs import TrialSpec
from testbed.experiment.trial_setup import setup_of
from testbed.protocol import FINISH, NONE, Decision, Percept, Robot, RobotStops, Task


def spec_of(config: str | Path, *overrides: str) -> TrialSpec:
    """The first trial of a configuration."""
    return plan_trials(load_config(str(config), list(overrides)))[0]


@dataclass
class Branch:
    """What a robot was told, and what it decided: decisions without their times."""

    percepts: list[Percept] = field(default_factory=list)
    decisions: list[object] = field(default_factory=list)


class Game:
    """The game of a trial, whose events are drawn with `rate` per step."""

    def __init__(self, spec: TrialSpec, rate: float) -> None:
        setup = setup_of(spec.setting)
        self.core: Core = setup.core(spec.setting)
        self.core.reset(seed=spec.seed, initial=spec.initial, trial=spec.trial)
        self.task: Task = setup.task(spec, self.core.situation.state, 0)
        self._rate = rate

    def play(self, robot: Robot, random: Random, steps: int, branch: Branch) -> Iterator[None]:
        """Stops before each of at most so many steps, and after them."""
        core = self.core
        for _ in range(steps):
            yield
            if core.situation.ending is not None:
                return
            percept = core.percept
            branch.percepts.append(percept)
            decision = told(robot, percept)
            branch.decisions.append(decision)
            if not isinstance(decision, Decision):
                return
            core.advance(decision.action, self._event(decision, random))
        yield

    def _event(self, decision: Decision, random: Random) -> Any:
        legal = self.core.legal_events(decision.action)
        if decision.action == FINISH or random.random() >= self._rate:
            return NONE
        events = [*self.core.adversary_actions]
        random.shuffle(events)
        return next(event for event in events if event in legal)


def told(robot: Robot, percept: Percept) -> object:
    """The decision without its times; where the robot stops, its reason."""
    try:
        return timeless(robot.act(percept))
    except RobotStops as stop:
        return str(stop)


def replayed(robot: Robot, task: Task, percepts: Sequence[Percept]) -> list[object]:
    """The decisions of a robot that begins, and is told all of them."""
    robot.begin(task)
    return [told(robot, percept) for percept in percepts]


def timeless(message: Any) -> Any:
    """A message without times, which differ whatever is decided."""
    changed = {
        name: 0.0 if name.endswith("_s") else timeless(getattr(message, name))
        for name in message.__struct_fields__
        if name.endswith("_s") or isinstance(getattr(message, name), Struct)
    }
    return structs.replace(message, **changed)
