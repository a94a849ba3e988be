"""The programs of decisions: what a robot of a stored trial reasoned with, as text for clingo."""

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path

from agents.intentional import Watched, program_of
from testbed.experiment.errors import StoreError
from testbed.experiment.record import TrialRecord
from testbed.experiment.replay import stored_trial
from testbed.experiment.robots import make_robot
from testbed.experiment.specs import TrialSpec
from testbed.experiment.storyteller import Moment
from testbed.experiment.timeline import of_place
from testbed.experiment.trial import play_trial
from testbed.link import InProcessRobot


@dataclass(frozen=True)
class Decisions:
    """The decisions of a stored trial that was played again, by step, each as a program."""

    title: str
    programs: Mapping[int, str]
    recorded: TrialRecord | None
    now: TrialRecord

    def program(self, step: int) -> str:
        """That of a step. Raises StoreError where the trial has none, or went otherwise before."""
        if self.recorded is not None and _until(step, self.recorded) != _until(step, self.now):
            raise StoreError(f"{self.title}: up to step {step} it does not go as on record")
        if step not in self.programs:
            near = min(self.programs, key=lambda other: abs(other - step), default="none")
            nothing = f"nothing is decided at step {step}; the nearest step with a decision: {near}"
            raise StoreError(f"{self.title}: {nothing}")
        return f"% {self.title}, step {step}\n%\n{self.programs[step]}"


def replay_decisions(folder: Path, trial: str) -> Decisions:
    """Those of the trial of a run whose id begins with `trial`.

    Raises as `stored_trial` and `decisions_of` do.
    """
    return decisions_of(*stored_trial(folder, trial))


def decisions_of(spec: TrialSpec, recorded: TrialRecord | None) -> Decisions:
    """Play a trial again, and keep what is decided.

    Raises StoreError for a robot that does not reason with the theory of intentions and for
    conformant plans, which are no part of it.
    """
    title = f"trial {spec.trial}: {of_place(spec.scenario, spec.level)}, {spec.robot}"
    robot = make_robot(spec.robot)
    if not isinstance(robot, Watched):
        raise StoreError(f"{title}: this robot does not reason with the theory of intentions")
    if spec.setting.plans == "conformant":
        search = "conformant plans are found by a search, which no theory states"
        raise StoreError(f"{title}: {search}; programs have plans: optimistic")
    latest, programs = list[str](), dict[int, str]()
    robot.watcher = lambda decided: latest.append(program_of(decided))

    def keep(moment: Moment) -> None:
        if latest:
            programs[moment.percept.step] = latest[-1]
            latest.clear()

    now = play_trial(spec, InProcessRobot(lambda _: robot), keep).record
    return Decisions(title, programs, recorded, now)


def _until(step: int, record: TrialRecord) -> list[object]:
    """What the robot and others did up to a step, and how the robot explained it."""
    return [
        [own for own in record.actions if own.step <= step],
        [(own.step, own.action) for own in record.exogenous if own.step <= step],
        [own for own in record.mental if own.step <= step],
        [own for own in record.explanations if own.step <= step],
    ]
