"""`summary.json`: what the pairs of a run come to, by scenario and by level."""

from __future__ import annotations

import json
from collections.abc import Collection, Iterable, Mapping
from pathlib import Path

from testbed.analysis.outline import Outline
from testbed.analysis.pairwise import Played, corrected, group
from testbed.experiment.digest import digest
from testbed.experiment.record import TrialRecord
from testbed.experiment.store import SUMMARY, read_records, replace_text
from testbed.studies.levels.analysis import summarise_levels
from testbed.studies.levels.outline import FineOutline, fine_outline
from testbed.studies.levels.published import OWN, Paper


def write_summary(
    folder: Path,
    covered: Mapping[str, object],
    sure: Collection[str],
    published: Mapping[str, object],
    paper: Paper,
) -> dict[str, object]:
    """Summarise the records of a run into its `summary.json`, and return what was written.

    Beside what `summarise` says, `digest` is the one number for all of its results; `covered`, how
    much of the plan they are, and `published` are added as they are.
    """
    number, found = digest(read_records(folder)), summarise(read_records(folder), sure, paper)
    summary = {"digest": number, **covered, **found, **published}
    replace_text(folder / SUMMARY, json.dumps(summary, indent=2) + "\n")
    return summary


def summarise(
    records: Iterable[TrialRecord], sure: Collection[str] = (), paper: Paper = OWN
) -> dict[str, object]:
    """Counts, accuracy, ratios (traditional / intentional) and tests by scenario and by level.

    At a level of the fine resolution come its columns of Tables 2 and 3 (`summarise_levels`), and
    what the `paper` has of them. `deadline` counts the trials with a decision that was cut off by
    the clock, which are in none of these numbers.
    `sure` are the eventful scenarios: a pair of theirs without its event is counted apart, and so
    is every other that compares nothing (`counting.why_apart`). A ratio is left out of the mean
    where the intentional robot's measure is 0; a measure without any ratio, and a test without any
    difference, is null.
    """
    trials = late = 0
    pairs: dict[tuple[str, str, str], dict[str, Outline]] = {}
    fine: dict[str, list[FineOutline]] = {}
    for record in records:
        trials += 1
        late += record.deadline
        if record.fine is not None and record.counts:
            fine.setdefault(record.level, []).append(fine_outline(record, record.fine))
        place = record.scenario, record.level, record.pair
        pairs.setdefault(place, {})[record.robot] = Outline(record)
    robots = dict.fromkeys(robot for own in pairs.values() for robot in own)
    scenarios, levels = _by_place(pairs)
    groups = [group(own, robots, sure) for own in (*scenarios.values(), *levels.values())]
    values = iter(own.values() for own in corrected(groups))
    columns = summarise_levels(fine, paper)
    return {
        "trials": trials,
        "deadline": late,
        "scenarios": {name: next(values) for name in scenarios},
        "levels": {name: next(values) | columns.get(name, {}) for name in levels},
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
