"""`summary.json`: what the pairs of a run come to, by scenario and by level."""

from __future__ import annotations

import json
from collections.abc import Collection, Iterable, Mapping
from pathlib import Path
from typing import Any

from testbed.analysis.outline import Outline
from testbed.analysis.pairwise import Played, corrected, group
from testbed.experiment.digest import digest
from testbed.experiment.record import TrialRecord
from testbed.experiment.store import SUMMARY, read_records, replace_text


def write_summary(
    folder: Path,
    covered: Mapping[str, object],
    sure: Collection[str],
    added: Iterable[Mapping[str, Any]] = (),
) -> dict[str, Any]:
    """Summarise the records of a run into its `summary.json`, and return what was written.

    Beside what `summarise` says, `digest` is the one number for all of its results; `covered`, how
    much of the plan they are, is added as it is, and what is `added` key by key.
    """
    number, found = digest(read_records(folder)), summarise(read_records(folder), sure)
    summary: dict[str, Any] = {"digest": number, **covered, **found}
    for own in added:
        summary = _joined(summary, own)
    replace_text(folder / SUMMARY, json.dumps(summary, indent=2) + "\n")
    return summary


def _joined(first: Mapping[str, Any], second: Mapping[str, Any]) -> dict[str, Any]:
    """Both, also inside of what both have."""
    common = {
        key: _joined(value, second[key])
        for key, value in first.items()
        if isinstance(value, Mapping) and isinstance(second.get(key), Mapping)
    }
    return {**first, **second, **common}


def summarise(records: Iterable[TrialRecord], sure: Collection[str] = ()) -> dict[str, Any]:
    """Counts, accuracy, ratios (traditional / intentional) and tests by scenario and by level.

    `deadline` counts the trials with a decision that was cut off by
    the clock, which are in none of these numbers.
    `sure` are the eventful scenarios: a pair of theirs without its event is counted apart, and so
    is every other that compares nothing (`counting.why_apart`). A ratio is left out of the mean
    where the intentional robot's measure is 0; a measure without any ratio, and a test without any
    difference, is null.
    """
    trials = late = 0
    pairs: dict[tuple[str, str, str], dict[str, Outline]] = {}
    for record in records:
        trials += 1
        late += record.deadline
        place = record.scenario, record.level, record.pair
        pairs.setdefault(place, {})[record.robot] = Outline(record)
    robots = dict.fromkeys(robot for own in pairs.values() for robot in own)
    scenarios, levels = _by_place(pairs)
    groups = [group(own, robots, sure) for own in (*scenarios.values(), *levels.values())]
    values = iter(own.values() for own in corrected(groups))
    return {
        "trials": trials,
        "deadline": late,
        "scenarios": {name: next(values) for name in scenarios},
        "levels": {name: next(values) for name in levels},
    }


def _by_place(
    pairs: Mapping[tuple[str, str, str], Mapping[str, Outline]],
) -> tuple[dict[str, list[Played]], dict[str, list[Played]]]:
    """The pairs by scenario, and by level."""
    scenarios: dict[str, list[Played]] = {}
    levels: dict[str, list[Played]] = {}
    for (scenario, level, name), trials in pairs.items():
        pair = Played(name, scenario, trials)
        scenarios.setdefault(scenario, []).append(pair)
        levels.setdefault(level, []).append(pair)
    return scenarios, levels
