"""Run folders of any size: trials that were played, on record under the names of others as well."""

from collections.abc import Iterator
from pathlib import Path

import msgspec

from testbed.config import ExperimentConfig
from testbed.experiment.plan import plan_trials
from testbed.experiment.record import TrialRecord
from testbed.experiment.recorder import NAMED, blank_record
from testbed.experiment.robots import make_robot
from testbed.experiment.run_folder import TRIALS, write_config
from testbed.experiment.shard import Shard
from testbed.experiment.specs import TrialSpec
from testbed.experiment.store import encode
from testbed.experiment.trial import play_trial
from testbed.link import InProcessRobot

OF_THE_PLAN = (*NAMED, "initial", "goal", "condition")
"""Keys of a record that are in the plan already."""


def make_run(folder: Path, config: ExperimentConfig, shard: Shard | None = None) -> int:
    """Make a run, or a part of one, of which few trials are played; how many records it has.

    Of the trials of one robot in one scenario from one initial state the first is played: the
    others have a copy of its record, with their own ids, seeds and conditions.
    """
    planned = plan_trials(config)
    specs = planned if shard is None else shard.of(planned)
    write_config(folder, config)
    with (folder / TRIALS).open("wb") as file:
        file.writelines(map(encode, _records(specs)))
    return len(specs)


def _records(specs: list[TrialSpec]) -> Iterator[TrialRecord]:
    robot = InProcessRobot(make_robot)
    played: dict[tuple[object, ...], TrialRecord] = {}
    for spec in specs:
        key = spec.scenario, spec.level, spec.robot, spec.initial
        if key not in played:
            played[key] = play_trial(spec, robot).record
        own = blank_record(spec)
        yield msgspec.structs.replace(
            played[key], **{name: getattr(own, name) for name in OF_THE_PLAN}
        )
