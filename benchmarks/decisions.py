"""Reasoning time of whole trials and single decisions, fast beside reference, scenarios 1 to 6."""

import multiprocessing
from collections.abc import Container, Sequence

from benchmarks.measuring import forget, median, no_collection, quantile
from benchmarks.sheets import DisagreementError, Row, Sheet
from benchmarks.trials import SCENARIOS, Played, play, specs
from testbed.experiment.specs import TrialSpec

TRIALS = {"small": 1, "full": 6}
WARM = {"small": 3, "full": 36}  # of these those that are not measured
FRESH = {"small": 1, "full": 3}
FRESH_SCENARIOS = {"small": SCENARIOS[:2], "full": SCENARIOS}


def main(size: str) -> list[Sheet]:
    """Sheets `trials`, `decisions` and `fresh`. Raises DisagreementError."""
    whole: list[Row] = []
    single: list[Row] = []
    fresh: list[Row] = []
    measured = {scenario: specs(scenario, TRIALS[size]) for scenario in SCENARIOS}
    starts = {spec.initial for trials in measured.values() for spec in trials}
    for scenario, trials in measured.items():
        _warm_up(scenario, WARM[size], starts)
        sides = _sides(trials)
        whole.append({"scenario": scenario, **_whole(sides)})
        single.append({"scenario": scenario, **_single(sides)})
        if scenario in FRESH_SCENARIOS[size]:
            fresh.append({"scenario": scenario, **_fresh(trials[: FRESH[size]])})
    return [
        Sheet(
            "trials",
            "Reasoning of a whole trial, domain grounded before",
            whole,
            (
                "trials from other initial states were played before: controls are grounded;",
                "fast: a trial for the first time, answers of earlier ones forgotten, the",
                "collector off; remembered: the same again, with what answers and clauses are kept",
            ),
        ),
        Sheet("decisions", "One decision of these trials", single),
        Sheet(
            "fresh",
            "The first trial of a fresh process, imports not counted",
            fresh,
            ("grounding: what the first trial takes more than the same one, forgotten, again",),
        ),
    ]


def _warm_up(scenario: str, number: int, starts: Container[tuple[str, ...]]) -> None:
    """Plays trials of a scenario that begin elsewhere: a trial that was played is known."""
    for spec in specs(scenario, number):
        if spec.initial not in starts:
            play(spec, "fast")


def _sides(trials: Sequence[TrialSpec]) -> dict[str, list[Played]]:
    """Each trial played by all sides in turn, so that they share whatever the machine does."""
    sides: dict[str, list[Played]] = {"fast": [], "remembered": [], "reference": []}
    for spec in trials:
        forget()
        with no_collection():
            sides["fast"].append(play(spec, "fast"))
            sides["remembered"].append(play(spec, "fast"))
            sides["reference"].append(play(spec, "reference"))
        answers = [sides[side][-1].answers for side in sides]
        if any(other != answers[0] for other in answers):
            raise DisagreementError(f"trial {spec.trial} of scenario {spec.scenario}")
    return sides


def _whole(sides: dict[str, list[Played]]) -> Row:
    fast, remembered, reference = (
        [played.whole_ms for played in sides[side]] for side in ("fast", "remembered", "reference")
    )
    return {
        "trials": len(fast),
        "fast_median_ms": median(fast),
        "fast_99_ms": quantile(fast, 0.99),
        "remembered_median_ms": median(remembered),
        "reference_median_ms": median(reference),
        "reference_99_ms": quantile(reference, 0.99),
        "times_faster": median([b / a for a, b in zip(fast, reference, strict=True)]),
        "agree": True,
    }


def _single(sides: dict[str, list[Played]]) -> Row:
    fast, remembered, reference = (
        [ms for played in sides[side] for ms in played.decisions_ms]
        for side in ("fast", "remembered", "reference")
    )
    return {
        "decisions": len(fast),
        "fast_median_ms": median(fast),
        "fast_99_ms": quantile(fast, 0.99),
        "remembered_median_ms": median(remembered),
        "remembered_99_ms": quantile(remembered, 0.99),
        "reference_median_ms": median(reference),
        "reference_99_ms": quantile(reference, 0.99),
        "times_faster": median([b / a for a, b in zip(fast, reference, strict=True)]),
    }


def _fresh(trials: Sequence[TrialSpec]) -> Row:
    context = multiprocessing.get_context("spawn")
    found: list[tuple[float, float, float]] = []
    for spec in trials:
        with context.Pool(1) as pool:
            found.append(pool.apply(first_trial, (spec,)))
    first, again, reference = zip(*found, strict=True)
    return {
        "processes": len(found),
        "first_ms": median(first),
        "again_ms": median(again),
        "grounding_ms": median([a - b for a, b in zip(first, again, strict=True)]),
        "reference_first_ms": median(reference),
    }


def first_trial(spec: TrialSpec) -> tuple[float, float, float]:
    """In a fresh process: the first trial, the same forgotten and again, and by the reference."""
    first = play(spec, "fast").whole_ms
    forget()
    again = play(spec, "fast").whole_ms
    return first, again, play(spec, "reference").whole_ms
