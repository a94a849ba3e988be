"""The trials of a run at the fine resolution, as far as they are held in memory."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass

from testbed.experiment.record import FAILURES, FineCounts, TrialRecord


@dataclass(frozen=True, slots=True)
class FineOutline:
    """The numbers of one trial; `seconds`, of process time, are by the names of PARTS.

    `decided`: whether it is known if the trial is correct.
    They are those of the whole trial: `coarse` is planning and diagnosis, `fine` refined plans and
    the inference of what came of them, `total` both; `refined_plan`, the mean time of one of them,
    is there where one was made.
    """

    robot: str
    pair: str
    played: bool
    achieved: bool
    correct: bool
    out_of_reach: bool
    plans: int
    actions: int
    tests: int
    seconds: Mapping[str, float]
    decided: bool = True


def fine_outline(record: TrialRecord, fine: FineCounts) -> FineOutline:
    """What is held of a record that has counts of the fine resolution."""
    return FineOutline(
        robot=record.robot,
        pair=record.pair,
        played=record.outcome not in FAILURES,
        achieved=record.achieved and record.outcome not in FAILURES,
        correct=record.correct is True,
        decided=record.correct is not None,
        out_of_reach=record.in_reach is False,
        plans=fine.plans,
        actions=fine.actions,
        tests=fine.tests,
        seconds=_seconds(record, fine),
    )


def _seconds(record: TrialRecord, fine: FineCounts) -> dict[str, float]:
    own = fine.planning_cpu_s + fine.infer_cpu_s
    coarse = record.planning_cpu_s + record.diagnosis_cpu_s
    seconds = {"total": own + coarse, "fine": own, "coarse": coarse}
    if fine.plans:
        seconds["refined_plan"] = fine.planning_cpu_s / fine.plans
    return seconds


def outlines_of(records: Iterable[TrialRecord]) -> dict[str, list[FineOutline]]:
    """The trials that count, by level."""
    levels: dict[str, list[FineOutline]] = {}
    for record in records:
        if record.fine is not None and record.counts:
            levels.setdefault(record.level, []).append(fine_outline(record, record.fine))
    return levels
