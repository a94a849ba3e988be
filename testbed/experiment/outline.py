"""The numbers of a trial that summaries compare."""

from __future__ import annotations

import sys
from collections.abc import Callable, Mapping

from testbed.experiment.counting import standing
from testbed.experiment.record import FAILURES, TrialRecord


class Outline:
    """The numbers of a record: what is held in memory of each trial of a large run.

    `state` names the initial state.
    """

    __slots__ = (
        "achieved",
        "action_count",
        "correct",
        "decided",
        "ended",
        "execution_units",
        "minimal_actions",
        "minimal_units",
        "planning_time_s",
        "plans",
        "standing",
        "state",
    )

    def __init__(self, record: TrialRecord) -> None:
        self.standing = standing(record)
        self.state = state_of(record)
        self.minimal_actions = record.minimal_actions
        self.minimal_units = record.minimal_units
        self.ended = record.outcome not in FAILURES
        self.achieved = record.achieved
        self.correct = record.correct is True
        self.decided = record.correct is not None
        self.plans = record.plans
        self.action_count = record.action_count
        self.execution_units = record.execution_units
        self.planning_time_s = record.planning_time_s

    @property
    def minimal(self) -> Mapping[str, int]:
        """The least that achieves the goal, by the names of measures, as far as it is known."""
        known = {"execution_units": self.minimal_units, "actions": self.minimal_actions}
        return {name: least for name, least in known.items() if least is not None}


MEASURES: Mapping[str, Callable[[Outline], float]] = {
    "total_time": lambda row: row.planning_time_s + row.execution_units,
    "plans": lambda row: row.plans,
    "planning_time": lambda row: row.planning_time_s,
    "execution_units": lambda row: row.execution_units,
    "actions": lambda row: row.action_count,
}


def state_of(record: TrialRecord) -> str:
    """The initial state of a trial, as a name; equal ones are one object."""
    return sys.intern(" ".join(record.initial))
