"""The published figures of Table 1 (P 4): traditional / intentional, and the accuracies."""

from collections.abc import Mapping
from dataclasses import dataclass

PLANNING = "planning_time"
MEASURES = ("total_time", "plans", PLANNING, "execution_units", "actions")
"""What is divided in each pair, in the order of the published columns."""

INTENTIONAL, BASELINE = "intentional", "traditional"
"""The robots whose figures were published: ATI and TP."""
SCENARIOS = ("1", "2", "3", "4", "5")
ALL = "all"
NO_FAILURES = ", no failures"
"""The end of a row's name: without the pairs in which the traditional robot fails."""


@dataclass(frozen=True)
class Published:
    """A published row: mean ratios by measure, and the share of correct trials of both robots."""

    ratios: Mapping[str, float]
    baseline: float
    treatment: float


def _row(*ratios: float, baseline: float) -> Published:
    return Published(dict(zip(MEASURES, ratios, strict=True)), baseline, 1.0)


PUBLISHED: Mapping[str, Published] = {
    "1": _row(0.81, 1.00, 0.45, 1.00, 1.00, baseline=1.00),
    "2": _row(3.06, 2.63, 1.08, 5.10, 3.61, baseline=1.00),
    "3": _row(0.81, 0.92, 0.34, 1.07, 1.12, baseline=0.72),
    "4": _row(1.00, 1.09, 0.40, 1.32, 1.26, baseline=0.73),
    "5": _row(0.18, 0.35, 0.09, 0.21, 0.28, baseline=0.00),
    ALL: _row(1.00, 1.08, 0.41, 1.39, 1.30, baseline=0.74),
    "3" + NO_FAILURES: _row(1.00, 1.11, 0.42, 1.32, 1.39, baseline=1.00),
    "4" + NO_FAILURES: _row(1.22, 1.31, 0.49, 1.61, 1.53, baseline=1.00),
    ALL + NO_FAILURES: _row(1.23, 1.30, 0.50, 1.72, 1.60, baseline=1.00),
}
