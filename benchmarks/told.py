"""Random pairs of Table 1 whose traditional robot is told when it explains too well.

`python -m benchmarks.told RUN OUT [--order ROOM ...]`

In the released simulator the traditional robot is told, when a new explanation means that the goal
holds, whether it does; if not, it takes the next explanation. At the end of a plan it is told
nothing. Here the pairs of a run are played again with such a robot: the same initial states, the
same events, the same trials of the intentional robot. With `--order` the robot tries the places of
what it misses in this order, in place of that in which the domain declares them.
"""

import argparse
import re
import sys
from collections.abc import Iterator, Sequence
from pathlib import Path

import msgspec

from agents.shared import Intention
from agents.traditional import TraditionalRobot
from asp.language import Description
from asp.reasoning.diagnosis import GOAL
from papers.table1.runs import told_name
from testbed.config import ConfigError, ExperimentConfig
from testbed.experiment import StoreError
from testbed.experiment.digest import digest
from testbed.experiment.plan import plan_trials
from testbed.experiment.record import TrialRecord
from testbed.experiment.run_folder import choose_folder, read_config, write_config
from testbed.experiment.store import TrialWriter, read_records
from testbed.experiment.trial import play_trial
from testbed.link import InProcessRobot
from testbed.protocol import Percept, Task
from testbed.studies.table1.measures import RANDOM
from testbed.studies.table1.published import BASELINE
from testbed.world import load_world

BAD_INPUT = 2


class ToldRobot(TraditionalRobot):
    """Is told that the goal does not hold, and heeds it, if its last explanation said that it does.

    `order` are the members of a sort in the order in which the robot's own domain declares them.
    """

    def __init__(self, order: Sequence[str] = ()) -> None:
        super().__init__()
        self._order = tuple(order)
        self._explained_goal = False

    def begin(self, task: Task) -> None:
        """Takes the task on, with its domain in the robot's order."""
        source = reordered(load_world(task.domain).description, self._order)
        super().begin(msgspec.structs.replace(task, source=source))

    def _attempt(self, intention: Intention) -> None:
        self._explained_goal = self._rest is None and GOAL in intention.believed
        super()._attempt(intention)

    def _observe(self, percept: Percept) -> None:
        super()._observe(percept)
        if percept.goal_holds is False and self._explained_goal:
            self._history.observe([GOAL.complement], percept.step)
            self._rest = None


def reordered(description: Description, order: Sequence[str]) -> str:
    """The text of a description in which a sort declares its members in this order.

    Raises ValueError where no sort has these members.
    """
    if not order:
        return description.source
    for sort, members in description.sorts.items():
        declared = rf"(?m)^(\s*){sort}\s*=[^.]*\."
        if sorted(members) == sorted(order) and re.search(declared, description.source):
            listed = rf"\g<1>{sort} = {{{', '.join(order)}}}."
            return re.sub(declared, listed, description.source, count=1)
    raise ValueError(f"--order: no sort of the domain has the members {', '.join(order)}")


def told(folder: Path, out: Path, order: Sequence[str]) -> Path:
    """Plays the random pairs of a run again into a new folder, which is returned.

    Raises StoreError, ConfigError, or ValueError for an order that the domain does not know.
    """
    config = read_config(folder)
    reordered(load_world(config.domain).description, order)
    chosen = choose_folder(out, out.name, resume=False)
    update = {"name": told_name(order), "scenarios": (RANDOM,)}
    write_config(chosen, config.model_copy(update=update))
    with TrialWriter(chosen) as writer:
        for record in (*_others(folder), *_played(config, order)):
            writer.append(record)
    return chosen


def _others(folder: Path) -> Iterator[TrialRecord]:
    """The trials that stay as they are."""
    return (r for r in read_records(folder) if r.scenario == RANDOM and r.robot != BASELINE)


def _played(config: ExperimentConfig, order: Sequence[str]) -> Iterator[TrialRecord]:
    robot = InProcessRobot(lambda _: ToldRobot(order))
    for spec in plan_trials(config):
        if spec.scenario == RANDOM and spec.robot == BASELINE:
            yield play_trial(spec, robot).record


def main(arguments: Sequence[str] | None = None) -> int:
    """The exit code: 0, or 2 with one line about what cannot be done."""
    parser = argparse.ArgumentParser("python -m benchmarks.told", description=__doc__)
    parser.add_argument("run", type=Path, metavar="RUN", help="run folder of Table 1")
    parser.add_argument("out", type=Path, metavar="OUT", help="new run folder")
    parser.add_argument("--order", nargs="*", default=(), metavar="ROOM", help="of explanations")
    given = parser.parse_args(arguments)
    try:
        folder = told(given.run, given.out, given.order)
        print(f"{folder}: digest of its results {digest(read_records(folder))}")
    except (StoreError, ConfigError, ValueError, OSError) as error:
        print(error, file=sys.stderr)
        return BAD_INPUT
    return 0


if __name__ == "__main__":
    sys.exit(main())
