"""Play a stored trial again, in this process, and tell it step by step."""

import shlex
from collections.abc import Sequence
from functools import partial
from pathlib import Path

from asp.language import suggestion
from testbed.experiment.digest import logical
from testbed.experiment.errors import StoreError
from testbed.experiment.narration import narrator_of
from testbed.experiment.plan import plan_trials
from testbed.experiment.recalled import Recalled
from testbed.experiment.record import TrialRecord
from testbed.experiment.robots import HUMAN, make_robot
from testbed.experiment.run_folder import read_config
from testbed.experiment.specs import TrialSpec
from testbed.experiment.store import read_records
from testbed.experiment.timeline import in_words, of_place, place
from testbed.experiment.trial import play_trial
from testbed.experiment.trial_setup import setup_of
from testbed.link import InProcessRobot
from testbed.protocol import Robot
from testbed.text import Say, columns, counted
from testbed.text.grid import Grid

NEWER = ("condition", "oracle_units", "unproved_steps", "unheeded_steps")
"""Keys that records of older versions do not have."""


def replay(folder: Path, trial: str, say: Say) -> bool:
    """Tell the trial of a run whose id begins with `trial`; is it as recorded?

    True also where there is no record of it yet.

    Raises as `stored_trial` does.
    """
    return replay_trial(*stored_trial(folder, trial), say)


def replay_trial(spec: TrialSpec, recorded: TrialRecord | None, say: Say) -> bool:
    """The same of a trial and its record."""
    where = of_place(spec.scenario, spec.level)
    under = f" under {spec.cell}" if spec.cell else ""
    say(f"trial {spec.trial}: {where}{under}, {spec.robot}, seed {spec.seed}")
    say(f"goal: {' '.join(spec.setting.goal)}")
    teller, narrator = setup_of(spec.setting).teller(spec.trial), narrator_of(spec.setting, say)
    robot = InProcessRobot(partial(_player, recorded))
    now = play_trial(spec, robot, lambda moment: narrator.tell(teller.tell(moment))).record
    reason = f": {now.reason}" if now.reason else ""
    steps, actions = counted(now.steps, "step"), counted(now.action_count, "action")
    units = counted(now.execution_units, "execution unit")
    say("")
    say(f"outcome {now.outcome}{reason} after {steps}, {actions}, {units}")
    return _compare(recorded, now, say)


def _player(recorded: TrialRecord | None, name: str) -> Robot:
    """The robot of a trial; in place of a person one that answers as recorded."""
    return Recalled(recorded) if name == HUMAN else make_robot(name)


def stored_trial(folder: Path, trial: str) -> tuple[TrialSpec, TrialRecord | None]:
    """The trial of a run whose id begins with `trial`, and its record if there is one yet.

    Raises:
        StoreError: for a folder without a run, or an id that is not one of its trials.
        ConfigError: where the stored configuration is not valid any more.
    """
    config = read_config(folder)
    played = [record for record in read_records(folder) if record.trial.startswith(trial)]
    # No trial depends on other levels, and where there are hundreds a level drawing all takes long.
    on_record = {record.level for record in played}
    levels = tuple(level for level in config.levels if level in on_record)
    if levels and trial:
        config = config.model_copy(update={"levels": levels})
    spec = find_trial(plan_trials(config), trial)
    return spec, next((own for own in played if own.trial == spec.trial), None)


def list_trials(folder: Path, say: Say) -> None:
    """Say which trials a run has, with their outcomes so far. Raises as `stored_trial`."""
    specs = plan_trials(read_config(folder))
    outcomes = {record.trial: record.outcome for record in read_records(folder)}
    fine = any(spec.setting.fine is not None for spec in specs)
    swept = any(spec.cell for spec in specs)
    heads = ("trial", "level" if fine else "scenario", *["condition"] * swept, "robot", "outcome")
    listed = ((s.trial, place(s.scenario, s.level), *[s.cell] * swept, s.robot) for s in specs)
    rows = [(*own, in_words(outcomes.get(own[0], "not played yet"))) for own in listed]
    for line in Grid(heads, rows, numbers=range(0)).lines(columns()):
        say(line)
    command = f"testbed replay {shlex.quote(str(folder))} --trial"
    say(f"choose one by its id, or the beginning of it: {command} {rows[-1][0]}")


def find_trial(specs: Sequence[TrialSpec], trial: str) -> TrialSpec:
    """The trial whose id begins with `trial`. Raises StoreError unless there is exactly one."""
    found = [spec for spec in specs if trial and spec.trial.startswith(trial)]
    if len(found) == 1:
        return found[0]
    if found:
        ids = ", ".join(spec.trial for spec in found[:5])
        raise StoreError(f"--trial {trial}: several trials begin so: {ids}")
    one = f"one of them is {specs[0].trial}"
    hint = suggestion(trial, [spec.trial for spec in specs], otherwise=one)
    among = f"not one of the run's {counted(len(specs), 'trial')}"
    raise StoreError(f"--trial {trial}: {among}; {hint}")


def _compare(recorded: TrialRecord | None, now: TrialRecord, say: Say) -> bool:
    if recorded is None:
        say("the run has no record of this trial yet")
        return True
    before, after = logical(recorded), logical(now)
    uncounted = {key for key in NEWER if before[key] is None}
    changed = [key for key in before if before[key] != after[key] and key not in uncounted]
    if not changed:
        say("as recorded")
    if recorded.outcome == "robot_lost":
        say(
            f"recorded as robot lost: {recorded.reason}; a robot that was lost there need not be "
            "lost again, for here it runs in this process and without a limit to its time"
        )
        return True
    for key in changed:
        say(f"differs from the record: {key} was {before[key]}, is {after[key]}")
    return not changed
