"""The columns of Tables 2 and 3 (P 4): reasoning of the trials of a level, by robot.

Seconds of reasoning are those of a whole trial: `coarse` is planning and diagnosis, `fine` refined
plans and the inference of what came of them, `total` both; `refined_plan` is a trial's mean.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from statistics import fmean, stdev

from testbed.experiment.levels.published import NO_ZOOM, PARTS, ZOOM
from testbed.experiment.record import FAILURES, FineCounts, TrialRecord

Spread = dict[str, float]


@dataclass(frozen=True, slots=True)
class FineOutline:
    """The numbers of one trial at the fine resolution; `seconds` are by the names of PARTS."""

    robot: str
    pair: str
    played: bool
    achieved: bool
    out_of_reach: bool
    plans: int
    actions: int
    seconds: Mapping[str, float]


def fine_outline(record: TrialRecord, fine: FineCounts) -> FineOutline:
    """What is held in memory of a record that has counts of the fine resolution."""
    own = fine.planning_time_s + fine.infer_time_s
    coarse = record.planning_time_s + record.diagnosis_time_s
    seconds = {"total": own + coarse, "fine": own, "coarse": coarse}
    if fine.plans:
        seconds["refined_plan"] = fine.planning_time_s / fine.plans
    return FineOutline(
        robot=record.robot,
        pair=record.pair,
        played=record.outcome not in FAILURES,
        achieved=record.achieved,
        out_of_reach=record.in_reach is False,
        plans=fine.plans,
        actions=fine.actions,
        seconds=seconds,
    )


def summarise_level(outlines: Sequence[FineOutline]) -> dict[str, object]:
    """The columns of a level: `reasoning` by robot, `zoom_ratios` (no zoom / zoom)."""
    robots = dict.fromkeys(outline.robot for outline in outlines)
    return {
        "reasoning": {name: _robot([o for o in outlines if o.robot == name]) for name in robots},
        "zoom_ratios": {part: _ratio(outlines, part) for part in PARTS},
    }


def _robot(outlines: Sequence[FineOutline]) -> dict[str, object]:
    """Trials that failed (a lost robot, an error) count as trials, and as not completed."""
    played = [outline for outline in outlines if outline.played]
    return {
        "trials": len(outlines),
        "achieved": sum(outline.achieved for outline in outlines),
        "out_of_reach": sum(outline.out_of_reach for outline in outlines),
        "completed": fmean(outline.achieved for outline in outlines),
        "refined_plans": _spread(outline.plans for outline in played),
        "concrete_actions": _spread(outline.actions for outline in played),
        **{part: _spread(o.seconds[part] for o in played if part in o.seconds) for part in PARTS},
    }


def _spread(values: Iterable[float]) -> Spread | None:
    """Mean and standard deviation of a sample; None of nothing."""
    sample = list(values)
    if not sample:
        return None
    return {"mean": fmean(sample), "sd": stdev(sample) if len(sample) > 1 else 0.0}


def _ratio(outlines: Sequence[FineOutline], part: str) -> float | None:
    """The mean of no zoom / zoom over the pairs of which both trials achieved their goal."""
    pairs: dict[str, dict[str, float]] = {}
    for outline in outlines:
        if outline.achieved and part in outline.seconds:
            pairs.setdefault(outline.pair, {})[outline.robot] = outline.seconds[part]
    ratios = [
        own[NO_ZOOM] / own[ZOOM] for own in pairs.values() if own.get(ZOOM) and NO_ZOOM in own
    ]
    return fmean(ratios) if ratios else None
