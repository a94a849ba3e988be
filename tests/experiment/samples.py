"""Records and types that the tests of this folder share."""

from collections.abc import Callable, Collection, Iterable, Sequence
from typing import Any

from testbed.analysis.comparison import Compared
from testbed.analysis.summary import summarise
from testbed.analysis.table import table_of
from testbed.config import ExperimentConfig
from testbed.experiment.record import Attempt, FineCounts, TrialRecord

Configure = Callable[..., ExperimentConfig]


def a_record(trial: str = "t1", **values: object) -> TrialRecord:
    """A record with these values, and plausible ones elsewhere."""
    given: dict[str, object] = {
        "pair": f"pair of {trial}",
        "scenario": "1",
        "seed": 1,
        "robot": "intentional",
        "domain": "office",
        "level": "coarse",
        "initial": [],
        "goal": ["loc(book1,library)"],
        "achieved": True,
        "finished": True,
        "correct": True,
        "outcome": "achieved",
        "minimal_actions": 1,
        "actions": [Attempt(1, "act", True)],
    }
    return TrialRecord(trial=trial, **(given | values))  # type: ignore[arg-type]


def a_level_record(trial: str, robot: str, level: str = "L3", **values: object) -> TrialRecord:
    """A record of a pair's trial at a level; `fine`, `infer`, `planning`, `diagnosis` are
    seconds of process time.

    Unless given they are 0.2, 0.1, 0.3 and 0.4; two refined plans are made.
    """
    times = {"fine": 0.2, "infer": 0.1, "planning": 0.3, "diagnosis": 0.4}
    own: Any = times | {key: values.pop(key) for key in times if key in values}
    achieved = bool(values.get("achieved", True))
    given: dict[str, object] = {
        "pair": trial,
        "robot": robot,
        "scenario": "levels",
        "level": level,
        "fine": FineCounts(plans=2, planning_cpu_s=own["fine"], infer_cpu_s=own["infer"]),
        "correct": achieved,
        "outcome": "achieved" if achieved else "gave_up",
        "planning_cpu_s": own["planning"],
        "diagnosis_cpu_s": own["diagnosis"],
    }
    return a_record(f"{trial} {robot}", **given | values)


def ids(records: Sequence[TrialRecord]) -> list[str]:
    """The trial ids of records, in their order."""
    return [record.trial for record in records]


def summary_of(
    records: Iterable[TrialRecord],
    sure: Collection[str] = (),
    treatments: Sequence[str] = ("intentional",),
) -> Any:
    """The summary of records, in which these robots are compared with the traditional one."""
    robots = [Compared("traditional", name) for name in treatments]
    return summarise(table_of(records), robots, sure)
