"""What the analysis of a run's levels gives, as `summary.json` holds it."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import msgspec

from testbed.analysis.statistics import Estimate, Test


class Spread(msgspec.Struct, frozen=True):
    """Mean, standard deviation and median of a sample."""

    mean: float
    sd: float
    median: float


class Reasoning(msgspec.Struct, frozen=True):
    """One robot at a level: how its trials ended, what it did in them; times are seconds.

    Trials that the robot's own error ended count as trials, and as not completed; those that
    something else ended are not among them.
    """

    trials: int
    achieved: int
    out_of_reach: int
    completed: float
    refined_plans: Spread | None
    concrete_actions: Spread | None
    total: Spread | None
    fine: Spread | None
    coarse: Spread | None
    refined_plan: Spread | None


class Ratio(msgspec.Struct, frozen=True):
    """A time without zooming, divided by that with it, over `pairs` that both have it.

    The test compares the times themselves; its effect is above 0 where zooming saves time.
    `of_sums` is the ratio of the sums over these pairs.
    """

    pairs: int
    mean: Estimate | None
    median: Estimate | None
    test: Test | None
    of_sums: float | None = None


class Growth(msgspec.Struct, frozen=True):
    """How many times the mean and the median at the first level a time has at this one."""

    mean: Estimate | None
    median: Estimate | None


class Compared(msgspec.Struct, frozen=True):
    """What can be compared across machines: shares, by robot; ratios, by part; growth, by both.

    The tests are McNemar's, of `pairs` that both robots played; their effect is above 0 where the
    one that zooms achieved its goal, or was correct, more often.
    """

    pairs: int
    completed: dict[str, Estimate]
    correct: dict[str, Estimate]
    ratios: dict[str, Ratio]
    growth: dict[str, dict[str, Growth]]
    completed_test: Test | None
    correct_test: Test | None


class Level(msgspec.Struct, frozen=True):
    """The columns of a level: `reasoning` by robot, `zoom_ratios` (the means), what is compared."""

    reasoning: dict[str, Reasoning]
    zoom_ratios: dict[str, float | None]
    compared: Compared


def levels_of(summary: Mapping[str, Any]) -> dict[str, Level]:
    """The columns of the levels that a summary holds, by name; none for a coarse run."""
    groups = summary["levels"].items()
    return {name: msgspec.convert(g, Level) for name, g in groups if "reasoning" in g}
