"""`summary.json`: what the trials of a run come to, by scenario and by level."""

from __future__ import annotations

import json
from collections.abc import Collection, Iterable, Iterator, Mapping, Sequence
from typing import Any

import polars as pl

from testbed.analysis.comparison import (
    Group,
    compared,
    corrected,
    eventful,
    group,
    measured,
    with_apart,
)
from testbed.analysis.pairs import Compared
from testbed.analysis.table import Run
from testbed.experiment.digest import digest
from testbed.experiment.run_folder import SUMMARY, replace_text

PLACES = {"scenarios": "scenario", "levels": "level"}


def write_summary(
    run: Run, covered: Mapping[str, object], added: Iterable[Mapping[str, Any]] = ()
) -> dict[str, Any]:
    """Summarise a run into its `summary.json`, and return what was written.

    Beside what `summarise` says, `digest` is the one number for all of its results; `covered`, how
    much of the plan they are, is added as it is, and what is `added` key by key.
    """
    found = summarise(run.trials, compared(run.config), eventful(run.config))
    summary: dict[str, Any] = {"digest": digest(run.records()), **covered, **found}
    for own in added:
        summary = _joined(summary, own)
    replace_text(run.folder / SUMMARY, json.dumps(summary, indent=2) + "\n")
    return summary


def _joined(first: Mapping[str, Any], second: Mapping[str, Any]) -> dict[str, Any]:
    """Both, also inside of what both have."""
    common = {
        key: _joined(value, second[key])
        for key, value in first.items()
        if isinstance(value, Mapping) and isinstance(second.get(key), Mapping)
    }
    return {**first, **second, **common}


def summarise(
    trials: pl.DataFrame, comparisons: Sequence[Compared], sure: Collection[str] = ()
) -> dict[str, Any]:
    """Counts, accuracy, ratios (baseline / treatment) and tests by scenario and by level.

    `deadline` counts the trials with a decision that was cut off by the clock, which are in none of
    these numbers. `sure` are the eventful scenarios: a pair of theirs without its event is counted
    apart, and so is every other that compares nothing (`with_apart`). A ratio is left out of the
    mean where the treatment's measure is 0; a measure without any ratio, and a test without any
    difference, is null. A group is that of the main comparison; those of further ones are in its
    `treatments`, by the name of the robot.
    """
    rows = measured(trials)
    places = [
        (key, name)
        for key, column in PLACES.items()
        for name in rows[column].unique(maintain_order=True)
    ]
    found = [
        (place, robots, own)
        for robots in comparisons
        for place, own in _groups(with_apart(rows, robots, sure), robots, places)
    ]
    groups: dict[str, Any] = {key: {} for key in PLACES}
    holm = corrected([own for _, _, own in found])
    for ((key, name), robots, _), own in zip(found, holm, strict=True):
        if robots == comparisons[0]:
            groups[key][name] = own.summary()
        else:
            groups[key][name].setdefault("treatments", {})[robots.treatment] = own.summary()
    return {
        "trials": len(rows),
        "deadline": int(rows["late"].sum()),
        "baseline": comparisons[0].baseline or None,
        "treatment": comparisons[0].treatment,
        **groups,
    }


def _groups(
    rows: pl.DataFrame, robots: Compared, places: Iterable[tuple[str, str]]
) -> Iterator[tuple[tuple[str, str], Group]]:
    names = rows["robot"].unique(maintain_order=True)
    for key, name in places:
        yield (key, name), group(rows.filter(pl.col(PLACES[key]) == name), robots, names)
