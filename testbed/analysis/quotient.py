"""How many times the mean, or the median, of one sample is that of another, with an interval."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
from scipy import stats  # type: ignore[import-untyped]  # scipy ships no types

from testbed.analysis.resampling import BATCH, CONFIDENCE, RESAMPLES, SEED, Values
from testbed.analysis.statistics import Estimate


def of_means(above: Values, below: Values) -> Estimate | None:
    """The quotient of the means of two independent samples, with its bootstrap interval.

    Both are of positive numbers; None where one of them is empty.
    """
    return _quotient(above, below, np.mean)


def of_medians(above: Values, below: Values) -> Estimate | None:
    """The quotient of the medians of two independent samples, as `of_means` has it."""
    return _quotient(above, below, np.median)


def _quotient(above: Values, below: Values, statistic: Callable[..., Any]) -> Estimate | None:
    """Percentiles over resamples, each sample being resampled by itself."""
    if not (len(above) and len(below)):
        return None

    def divided(first: Values, second: Values, axis: int = -1) -> Any:
        return statistic(first, axis=axis) / statistic(second, axis=axis)

    value = float(divided(above, below))
    if np.ptp(above) == np.ptp(below) == 0:
        return Estimate(value, value, value, single=len(above) == len(below) == 1)
    interval = stats.bootstrap(
        [values if len(values) > 1 else np.repeat(values, 2) for values in (above, below)],
        divided,
        n_resamples=RESAMPLES,
        batch=BATCH,
        confidence_level=CONFIDENCE,
        method="percentile",
        rng=np.random.default_rng(SEED),
    ).confidence_interval
    return Estimate(value, float(interval.low), float(interval.high))
