"""`summary.json`: accuracy by robot, mean of pairwise ratios, tests of significance."""

from __future__ import annotations

import json
from collections import defaultdict
from collections.abc import Callable, Iterable, Mapping, Sequence
from pathlib import Path
from statistics import fmean

from scipy import stats  # type: ignore[import-untyped]  # scipy ships no types

from testbed.experiment.digest import digest
from testbed.experiment.levels.analysis import summarise_levels
from testbed.experiment.levels.outline import FineOutline, fine_outline
from testbed.experiment.record import FAILURES, TrialRecord
from testbed.experiment.store import SUMMARY, read_records, replace_text

BASELINE, INTENTIONAL = "traditional", "intentional"


class Outline:
    """The numbers of a record: what is held in memory of each trial of a large run."""

    __slots__ = ("action_count", "correct", "ended", "execution_units", "planning_time_s", "plans")

    def __init__(self, record: TrialRecord) -> None:
        self.ended = record.outcome not in FAILURES
        self.correct = record.correct
        self.plans = record.plans
        self.action_count = record.action_count
        self.execution_units = record.execution_units
        self.planning_time_s = record.planning_time_s


MEASURES: Mapping[str, Callable[[Outline], float]] = {
    "total_time": lambda row: row.planning_time_s + row.execution_units,
    "plans": lambda row: row.plans,
    "planning_time": lambda row: row.planning_time_s,
    "execution_units": lambda row: row.execution_units,
    "actions": lambda row: row.action_count,
}
Pairs = dict[str, dict[str, Outline]]


def write_summary(folder: Path) -> dict[str, object]:
    """Summarise the records of a run into its `summary.json`, and return what was written.

    Beside what `summarise` says, `digest` is the one number for all of its results.
    """
    summary = {"digest": digest(read_records(folder)), **summarise(read_records(folder))}
    replace_text(folder / SUMMARY, json.dumps(summary, indent=2) + "\n")
    return summary


def summarise(records: Iterable[TrialRecord]) -> dict[str, object]:
    """Counts, accuracy, ratios (traditional / intentional) and p-values by scenario and by level.

    At a level of the fine resolution come its columns of Tables 2 and 3 (`summarise_levels`).
    Measures are compared in pairs of which both trials ended by themselves; a pair with an error or
    a lost robot is counted in `failed_pairs`. A ratio is left out of the mean where the intentional
    robot's measure is 0; a measure without any ratio, and a test without any difference, is null.
    """
    scenarios: dict[str, Pairs] = defaultdict(lambda: defaultdict(dict))
    levels: dict[str, Pairs] = defaultdict(lambda: defaultdict(dict))
    fine: dict[str, list[FineOutline]] = defaultdict(list)
    trials = 0
    for record in records:
        trials += 1
        if record.fine is not None:
            fine[record.level].append(fine_outline(record, record.fine))
        scenarios[record.scenario][record.pair][record.robot] = Outline(record)
        levels[record.level][record.pair][record.robot] = Outline(record)
    columns = summarise_levels(fine)
    return {
        "trials": trials,
        "scenarios": {name: _group(pairs) for name, pairs in scenarios.items()},
        "levels": {name: _group(pairs) | columns.get(name, {}) for name, pairs in levels.items()},
    }


def _group(pairs: Pairs) -> dict[str, object]:
    complete = [
        (pair[BASELINE], pair[INTENTIONAL])
        for pair in pairs.values()
        if BASELINE in pair and INTENTIONAL in pair
    ]
    ended = [(base, mind) for base, mind in complete if base.ended and mind.ended]
    p_values = {name: _wilcoxon(ended, measure) for name, measure in MEASURES.items()}
    return {
        "pairs": len(pairs),
        "failed_pairs": len(complete) - len(ended),
        "accuracy": _accuracy(pairs),
        "ratios": {name: _ratio(ended, measure) for name, measure in MEASURES.items()},
        "p_values": p_values | {"accuracy": _mcnemar(complete)},
    }


def _accuracy(pairs: Pairs) -> dict[str, float]:
    correct: dict[str, list[bool]] = defaultdict(list)
    for pair in pairs.values():
        for robot, row in pair.items():
            correct[robot].append(row.correct)
    return {robot: fmean(values) for robot, values in correct.items()}


def _ratio(
    pairs: Sequence[tuple[Outline, Outline]], measure: Callable[[Outline], float]
) -> float | None:
    ratios = [measure(base) / measure(mind) for base, mind in pairs if measure(mind)]
    return fmean(ratios) if ratios else None


def _wilcoxon(
    pairs: Sequence[tuple[Outline, Outline]], measure: Callable[[Outline], float]
) -> float | None:
    differences = [measure(base) - measure(mind) for base, mind in pairs]
    if not any(differences):
        return None
    return float(stats.wilcoxon(differences).pvalue)


def _mcnemar(pairs: Sequence[tuple[Outline, Outline]]) -> float | None:
    """Exact McNemar test: are the pairs that only one robot got right split evenly?"""
    only_baseline = sum(base.correct and not mind.correct for base, mind in pairs)
    only_mind = sum(mind.correct and not base.correct for base, mind in pairs)
    if not only_baseline + only_mind:
        return None
    return float(stats.binomtest(only_mind, only_baseline + only_mind).pvalue)
