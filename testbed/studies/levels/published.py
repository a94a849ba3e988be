"""The published figures of the levels (P 4, Tables 2 and 3): seconds, mean and deviation."""

from collections.abc import Mapping
from dataclasses import dataclass, field

from testbed.studies.tables import HALF_DIGIT, Rounded

ZOOM, NO_ZOOM = "intentional", "intentional-nozoom"
"""The robots of the two conditions, by their names here."""

FIRST = "L1"
"""The level that the others are compared with for growth."""

PARTS = ("total", "fine", "coarse", "refined_plan")
"""Reasoning of a trial, its part at each resolution, and the time of one refined plan."""


@dataclass(frozen=True)
class Published:
    """What the paper gives for one level and condition; a part that it does not give is absent."""

    completed: float
    seconds: Mapping[str, tuple[float, float]]


def _published(completed: float, *parts: tuple[float, float]) -> Published:
    return Published(completed, dict(zip(PARTS, parts, strict=True) if parts else ()))


PUBLISHED: Mapping[tuple[str, str], Published] = {
    ("L1", ZOOM): _published(1.0, (6.24, 1.56), (1.57, 0.51), (4.67, 1.05), (0.37, 0.02)),
    ("L2", ZOOM): _published(1.0, (8.82, 2.95), (2.53, 0.92), (6.29, 2.06), (0.41, 0.02)),
    ("L3", ZOOM): _published(1.0, (11.59, 3.88), (4.19, 1.48), (7.40, 2.57), (0.56, 0.05)),
    ("L4", ZOOM): _published(1.0, (18.63, 5.49), (8.89, 2.99), (9.74, 3.26), (0.95, 0.26)),
    ("L5", ZOOM): _published(1.0, (22.73, 7.46), (10.78, 4.08), (11.95, 4.17), (0.98, 0.22)),
    ("L6", ZOOM): _published(1.0, (29.80, 10.55), (17.77, 7.55), (12.03, 4.33), (1.64, 0.68)),
    ("L7", ZOOM): _published(1.0, (41.93, 17.26), (30.07, 15.48), (11.86, 4.12), (2.30, 1.02)),
    ("L8", ZOOM): _published(1.0, (42.99, 18.04), (29.36, 15.76), (13.63, 5.07), (2.30, 1.09)),
    ("L1", NO_ZOOM): _published(1.0, (6.28, 1.57), (1.61, 0.54), (4.67, 1.03), (0.39, 0.01)),
    ("L2", NO_ZOOM): _published(1.0, (10.74, 4.14), (4.46, 2.29), (6.28, 2.06), (0.93, 0.32)),
    ("L3", NO_ZOOM): _published(
        0.65, (225.49, 177.64), (218.1, 176.97), (7.39, 2.58), (45.98, 43.05)
    ),
    **{(f"L{number}", NO_ZOOM): _published(0.0) for number in range(4, 9)},
}

RATIOS: Mapping[str, Mapping[str, float]] = {
    "L1": dict(zip(PARTS, (1.01, 1.02, 1.00, 1.03), strict=True)),
    "L2": dict(zip(PARTS, (1.20, 1.71, 1.00, 2.26), strict=True)),
    "L3": dict(zip(PARTS, (20.07, 55.23, 1.00, 83.49), strict=True)),
}
"""No zoom / zoom, over the trials that achieved their goal; nothing is given from L4 on."""


@dataclass(frozen=True)
class Paper:
    """What the paper gives for the levels of a run; without figures for a run of one's own."""

    conditions: Mapping[tuple[str, str], Published] = field(default_factory=dict)
    ratios: Mapping[str, Mapping[str, float]] = field(default_factory=dict)

    def seconds(self, level: str, robot: str, part: str) -> tuple[float, float] | None:
        """Mean and standard deviation."""
        known = self.conditions.get((level, robot))
        return None if known is None else known.seconds.get(part)

    def completed(self, level: str, robot: str) -> Rounded | None:
        """The share of the trials that ended with their goal achieved."""
        known = self.conditions.get((level, robot))
        return None if known is None else Rounded(known.completed)

    def ratio(self, level: str, part: str) -> Rounded | None:
        """No zoom / zoom."""
        known = self.ratios.get(level, {})
        return Rounded(known[part]) if part in known else None

    def growth(self, level: str, robot: str, part: str) -> Rounded | None:
        """The mean of a level, divided by that of the first one; both had been rounded."""
        above, below = self.seconds(level, robot, part), self.seconds(FIRST, robot, part)
        if above is None or below is None:
            return None
        most = (above[0] + HALF_DIGIT) / (below[0] - HALF_DIGIT)
        return Rounded(above[0] / below[0], most - above[0] / below[0])


PAPER = Paper(PUBLISHED, RATIOS)
OWN = Paper()
"""For a run that is not made to be compared with the published figures."""
