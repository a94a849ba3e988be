"""The limits of a task as reasoning keeps to them."""

from __future__ import annotations

from asp.solving import Limits
from testbed.protocol import Task

SEARCH, BETTERING = 0.5, 0.75
"""The parts of a decision's conflicts by which a diagnosis has looked for the smallest explanation,
and then for the best it can find; what is left is for planning."""


def limits_of(task: Task) -> Limits:
    """What a decision about a task may take."""
    return Limits(task.decision_s, task.conflicts, task.ground_rules, task.expansions)
