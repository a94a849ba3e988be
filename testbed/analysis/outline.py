"""The numbers of a trial that summaries compare."""

from __future__ import annotations

import sys
from collections.abc import Callable, Mapping

from testbed.analysis.counting import standing
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
        "diagnosis_cpu_s",
        "ended",
        "execution_units",
        "minimal_actions",
        "minimal_units",
        "planning_cpu_s",
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
        self.planning_cpu_s = record.planning_cpu_s
        self.diagnosis_cpu_s = record.diagnosis_cpu_s

    @property
    def minimal(self) -> Mapping[str, int]:
        """The least that achieves the goal, by the names of measures, as far as it is known."""
        known = {"execution_units": self.minimal_units, "actions": self.minimal_actions}
        return {name: least for name, least in known.items() if least is not None}


MEASURES: Mapping[str, Callable[[Outline], float]] = {
    "total_time": lambda row: row.planning_cpu_s + row.execution_units,
    "plans": lambda row: row.plans,
    "planning_time": lambda row: row.planning_cpu_s,
    "execution_units": lambda row: row.execution_units,
    "actions": lambda row: row.action_count,
}
"""What the tests compare; times are process time, which a loaded machine does not stretch."""
TIMES: Mapping[str, Callable[[Outline], float]] = {
    "planning_time": MEASURES["planning_time"],
    "diagnosis_time": lambda row: row.diagnosis_cpu_s,
    "reasoning_time": lambda row: row.planning_cpu_s + row.diagnosis_cpu_s,
}
"""Planning, diagnosis, and both."""
DIVIDED: Mapping[str, Callable[[Outline], float]] = {**MEASURES, **TIMES}
"""What is divided in a pair; of these the tests compare `MEASURES` alone."""


def state_of(record: TrialRecord) -> str:
    """The initial state of a trial, as a name; equal ones are one object."""
    return sys.intern(" ".join(record.initial))
