"""Play a stored trial again, in this process, and tell it step by step."""

from __future__ import annotations

import shlex
from collections.abc import Iterable
from pathlib import Path

from asp.language import suggestion
from testbed.config import ExperimentConfig
from testbed.experiment.digest import logical
from testbed.experiment.errors import StoreError
from testbed.experiment.narration import Say, narrator_of
from testbed.experiment.plan import plan_trials
from testbed.experiment.record import TrialRecord
from testbed.experiment.recorder import Result
from testbed.experiment.robots import make_robot
from testbed.experiment.run_folder import read_config
from testbed.experiment.specs import TrialSpec
from testbed.experiment.store import read_records
from testbed.experiment.timeline import in_words, of_place, place
from testbed.experiment.trial import play_trial
from testbed.link import InProcessRobot
from testbed.text.grid import Grid
from testbed.text.terminal import columns
from testbed.text.wording import counted


def replay(folder: Path, trial: str, say: Say) -> bool:
    """Tell the trial of a run whose id begins with `trial`; is it as recorded?

    True also where there is no record of it yet.

    Raises:
        StoreError: for a folder without a run, or an id that is not one of its trials.
        ConfigError: where the stored configuration is not valid any more.
    """
    spec = find_trial(plan_trials(_at_its_level(folder, trial)), trial)
    listed = of_place(spec.scenario, spec.level)
    say(f"trial {spec.trial}: {listed}, {spec.robot}, seed {spec.seed}")
    say(f"goal: {' '.join(spec.setting.goal)}")
    result = play_trial(spec, InProcessRobot(make_robot), narrator_of(spec.setting, say).tell)
    _tell_end(result, say)
    return _compare(_recorded(folder, spec), result.record, say)


def _at_its_level(folder: Path, trial: str) -> ExperimentConfig:
    """The configuration of a run, of its levels only that of a trial which is on record.

    No trial depends on other levels, and where there are hundreds a level drawing all takes long.
    """
    config = read_config(folder)
    played = {record.level for record in read_records(folder) if record.trial.startswith(trial)}
    levels = tuple(level for level in config.levels if level in played)
    return config.model_copy(update={"levels": levels}) if levels and trial else config


def list_trials(folder: Path, say: Say) -> None:
    """Say which trials a run has, with their outcomes so far. Raises as `replay`."""
    specs = plan_trials(read_config(folder))
    outcomes = {record.trial: record.outcome for record in read_records(folder)}
    fine = any(spec.setting.fine is not None for spec in specs)
    rows = [
        (
            s.trial,
            place(s.scenario, s.level),
            s.robot,
            in_words(outcomes.get(s.trial, "not played yet")),
        )
        for s in specs
    ]
    heads = ("trial", "level" if fine else "scenario", "robot", "outcome")
    for line in Grid(heads, rows, numbers=range(0)).lines(columns()):
        say(line)
    command = f"testbed replay {shlex.quote(str(folder))} --trial"
    say(f"choose one by its id, or the beginning of it: {command} {rows[-1][0]}")


def find_trial(specs: Iterable[TrialSpec], trial: str) -> TrialSpec:
    """The trial whose id begins with `trial`. Raises StoreError unless there is exactly one."""
    known = list(specs)
    found = [spec for spec in known if trial and spec.trial.startswith(trial)]
    if len(found) == 1:
        return found[0]
    if found:
        ids = ", ".join(spec.trial for spec in found[:5])
        raise StoreError(f"--trial {trial}: several trials begin so: {ids}")
    near = suggestion(trial, [spec.trial for spec in known])
    hint = near if near.startswith("did") else f"one of them is {known[0].trial}"
    raise StoreError(
        f"--trial {trial}: not one of the run's {counted(len(known), 'trial')}; {hint}"
    )


def _tell_end(result: Result, say: Say) -> None:
    record = result.record
    say("")
    reason = f": {record.reason}" if record.reason else ""
    steps, actions = counted(record.steps, "step"), counted(record.action_count, "action")
    units = counted(record.execution_units, "execution unit")
    say(f"outcome {record.outcome}{reason} after {steps}, {actions}, {units}")


def _recorded(folder: Path, spec: TrialSpec) -> TrialRecord | None:
    return next((r for r in read_records(folder) if r.trial == spec.trial), None)


def _compare(recorded: TrialRecord | None, now: TrialRecord, say: Say) -> bool:
    if recorded is None:
        say("the run has no record of this trial yet")
        return True
    before, after = logical(recorded), logical(now)
    changed = [key for key in before if before[key] != after[key]]
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
