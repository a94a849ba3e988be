"""`summary.json`: what the trials of a run come to, by scenario and by level."""

import json
from collections import Counter
from collections.abc import Collection, Iterable, Iterator, Mapping, Sequence
from typing import Any, TypeAlias

import polars as pl

from testbed.analysis import comparison, quality
from testbed.analysis.answers import answers_of
from testbed.analysis.comparison import ACCURACY, COUNTS, DIVIDED, MEASURES, TIMES
from testbed.analysis.pairs import OTHER, Compared, Sample, corrected, pairs_of
from testbed.analysis.population import exhausted
from testbed.analysis.run import Run
from testbed.analysis.statistics import Test
from testbed.analysis.table import Trials
from testbed.experiment.run_folder import SUMMARY, replace_text

Tests: TypeAlias = Mapping[str, Test | None]
PLACES = {"scenarios": "scenario", "levels": "level"}
MAIN, EXPLANATIONS = "", "explanation_tests"
PAIRED = ("pair", "robot", "state", "ended")
"""What both trials of a pair have, whatever is compared; the rest is as much as is asked for."""
FAMILIES = (MAIN, EXPLANATIONS)
"""Tests that are corrected together; those of explanations are a part of the summary."""


def write_summary(
    run: Run, covered: Mapping[str, object], added: Iterable[Mapping[str, Any]] = ()
) -> dict[str, Any]:
    """Summarise a run into its `summary.json`, and return what was written.

    Beside what `summarise` says, `digest` is the one number for all of its results, `answers` are
    those of `answers_of`, `exhaustive` the scenarios that are `exhausted`; `covered`, how much of
    the plan they are, is added as it is, and what is `added` key by key.
    """
    found = summarise(run.table, comparison.compared(run.config), comparison.eventful(run.config))
    summary: dict[str, Any] = {
        "digest": run.digest,
        **covered,
        "answers": answers_of(run),
        "exhaustive": sorted(exhausted(run)),
        **found,
    }
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
    trials: Trials, comparisons: Sequence[Compared], sure: Collection[str] = ()
) -> dict[str, Any]:
    """Counts, accuracy, ratios (baseline / treatment) and tests by scenario and by level.

    `deadline` counts the trials with a decision that was cut off by the clock, which are in none of
    these numbers. `sure` are the eventful scenarios: a pair of theirs without its event is counted
    apart, and so is every other that compares nothing (`with_apart`). Ratios, and the tests of what
    is divided, are of the pairs in which both achieve their goal. A ratio is left out of the
    mean where the treatment's measure is 0; a measure without any ratio, and a test without any
    difference, is null. P-values are corrected over all groups, those of explanations apart; those
    of the same robots and pairs, as of the only scenario of a level, are one. A group is that of
    the main comparison; those of further ones are in its `treatments`, by the name of the robot.
    """
    rows = comparison.measured(trials)
    names = rows["robot"].unique(maintain_order=True)
    found = {
        (key, own[column][0], robots): _group(own, robots, names)
        for robots in comparisons
        for key, column in PLACES.items()
        for own in _parts(comparison.with_apart(rows, robots, sure), column)
    }
    families = {
        family: corrected({(own[-1], pairs): t[family] for own, (pairs, _, t) in found.items()})
        for family in FAMILIES
    }
    groups: dict[str, Any] = {key: {} for key in PLACES}
    for (key, name, robots), (pairs, values, _) in found.items():
        tests = {family: _of_tests(own[robots, pairs]) for family, own in families.items()}
        summary = {**values, **tests.pop(MAIN), **tests}
        if robots == comparisons[0]:
            groups[key][name] = summary
        else:
            groups[key][name].setdefault("treatments", {})[robots.treatment] = summary
    return {
        "trials": len(rows),
        "deadline": int(rows["late"].sum()),
        "baseline": comparisons[0].baseline or None,
        "treatment": comparisons[0].treatment,
        **groups,
    }


def _parts(trials: pl.DataFrame, column: str) -> Iterator[pl.DataFrame]:
    """The rows of each value of a column, one part after the other: a large table is not copied."""
    for name in trials[column].unique(maintain_order=True):
        yield trials.filter(pl.col(column) == name)


def _group(
    trials: pl.DataFrame, robots: Compared, names: Iterable[str]
) -> tuple[frozenset[str], dict[str, Any], Mapping[str, Tests]]:
    """Of the trials of a scenario or level, `with_apart`: the pairs that count, values, and tests.

    `names` are the run's robots in order. Tests are by family and measure, of the baseline's less
    the treatment's; of `accuracy`, and shares of explanations, the other way round.
    """
    reasons = Counter(trials.unique("pair")["apart"].drop_nulls().to_list())
    counted = trials.filter(pl.col("apart").is_null())
    played = set(trials["robot"].unique())
    own = {name: counted.filter(pl.col("robot") == name) for name in names if name in played}
    both = Sample(pairs_of(counted.select(*PAIRED, "correct", "achieved", *DIVIDED), robots))
    explaining = Sample(pairs_of(counted.select(*PAIRED, *quality.OF), robots))
    achieved = both.achieved
    ratios = _ratios(achieved.pairs)
    tests = {name: achieved.signed_rank(name) for name in MEASURES}
    values = {
        "pairs": counted["pair"].n_unique(),
        **{key: reasons[reason] for reason, key in COUNTS.items()},
        "robot_errors": {name: (~rows["ended"]).sum() for name, rows in own.items()},
        "accuracy": {name: rows["correct"].mean() for name, rows in own.items()},
        "both_achieve": len(achieved.pairs),
        "undecided": {name: rows["correct"].null_count() for name, rows in own.items()},
        "ratios": {name: ratios[name]["ratio"] for name in MEASURES},
        "ratios_of_sums": {name: ratios[name]["of_sums"] for name in MEASURES},
        "times": {name: ratios[name] for name in TIMES},
        "unproved_steps": {name: rows["unproved_steps"].mean() for name, rows in own.items()},
        "optimum": {name: comparison.optimum(rows) for name, rows in own.items()},
        "explanations": {
            name: explained
            for name, rows in own.items()
            if (explained := quality.numbers(rows.filter("ended")))
        },
    }
    tests[ACCURACY] = both.decided.mcnemar("correct")
    return (
        frozenset(counted["pair"]),
        values,
        {MAIN: tests, EXPLANATIONS: quality.tests(explaining.ended)},
    )


def _of_tests(tests: Tests) -> dict[str, dict[str, float | None]]:
    keys = {"p_values": "p", "holm": "holm", "effects": "effect"}
    return {
        key: {name: getattr(test, own, None) for name, test in tests.items()}
        for key, own in keys.items()
    }


def _ratios(pairs: pl.DataFrame) -> dict[str, dict[str, Any]]:
    """The mean ratio of each measure, where the treatment's is not 0, and the ratio of the sums."""
    found = {}
    for name in DIVIDED:
        own, other = pl.col(name), pl.col(name + OTHER)
        mean = (own / other).filter(other != 0).mean()
        of_sums = pl.when(other.sum() != 0).then(own.sum() / other.sum())
        found[name] = pairs.select(ratio=mean, of_sums=of_sums).row(0, named=True)
    return found
