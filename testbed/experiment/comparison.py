"""The summary as a table: how the two robots compare in each scenario, and in all of them."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from typing import Any

from testbed.experiment.summary import BASELINE, INTENTIONAL, MEASURES

ROBOTS = (INTENTIONAL, BASELINE)


@dataclass(frozen=True)
class Cell:
    """A value, and how likely such a difference is by chance; "" where nothing differs."""

    label: str
    value: str
    chance: str = ""


@dataclass(frozen=True)
class Comparison:
    """The cells of one scenario, "all" for all of them."""

    scenario: str
    cells: tuple[Cell, ...]


def comparisons(summary: Mapping[str, Any]) -> list[Comparison]:
    """One row a scenario, then one for all; none where not both robots played."""
    groups = dict(summary["scenarios"])
    if len(groups) > 1:
        levels = summary["levels"]
        groups |= {"all" if len(levels) == 1 else f"all, {name}": levels[name] for name in levels}
    if not any(set(ROBOTS) <= set(group["accuracy"]) for group in groups.values()):
        return []
    return [Comparison(name, tuple(_cells(group))) for name, group in groups.items()]


def _cells(group: Mapping[str, Any]) -> Iterator[Cell]:
    chances = group["p_values"] if group["pairs"] - group["failed_pairs"] > 1 else {}
    failed = group["failed_pairs"]
    yield Cell("pairs", f"{group['pairs']}, {failed} failed" if failed else str(group["pairs"]))
    for robot in ROBOTS:
        share = group["accuracy"].get(robot)
        chance = _chance(chances.get("accuracy")) if robot == INTENTIONAL else ""
        yield Cell(f"{robot} correct", "-" if share is None else f"{100 * share:.1f} %", chance)
    for measure in MEASURES:
        ratio = group["ratios"][measure]
        value = "-" if ratio is None else f"{ratio:.2f}"
        yield Cell(measure.replace("_", " "), value, _chance(chances.get(measure)))


def _chance(p_value: float | None) -> str:
    if p_value is None:
        return ""
    return "p < 0.001" if p_value < 0.001 else f"p = {p_value:.3f}"
