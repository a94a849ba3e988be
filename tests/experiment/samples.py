"""Records and types that the tests of this folder share."""

from collections.abc import Callable, Sequence

from testbed.config import ExperimentConfig
from testbed.experiment.record import TrialRecord

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
    }
    return TrialRecord(trial=trial, **(given | values))  # type: ignore[arg-type]


def ids(records: Sequence[TrialRecord]) -> list[str]:
    """The trial ids of records, in their order."""
    return [record.trial for record in records]
