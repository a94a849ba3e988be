"""How two robots compare in a run of one's own: accuracy and ratios with intervals by scenario."""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterable, Iterator, Mapping, Sequence

import numpy as np

from testbed.analysis.counting import BASELINE, INTENTIONAL
from testbed.analysis.outline import MEASURES, Outline
from testbed.analysis.statistics import Estimate, mean, proportion
from testbed.experiment.record import TrialRecord
from testbed.experiment.wording import in_words, place
from testbed.report.figures import Panel, Point, Series, estimated, forest
from testbed.report.svg import FIRST, SECOND

LEAST = 2
"""Pairs of a scenario from which on an interval says something."""

Pair = tuple[Outline, Outline]
"""The intentional robot's trial and the traditional one's."""


def panels(records: Iterable[TrialRecord], apart: Collection[str]) -> list[Panel]:
    """A figure of the accuracies and one for each ratio; none without pairs to compare.

    The pairs that are `apart` do not count.
    """
    counted = (record for record in records if record.pair not in apart)
    groups = {name: pairs for name, pairs in _groups(counted).items() if len(pairs) >= LEAST}
    if not groups:
        return []
    rows = list(groups)
    shares = [
        _series(INTENTIONAL, FIRST, groups, lambda pairs: _share([own for own, _ in pairs])),
        _series(BASELINE, SECOND, groups, lambda pairs: _share([own for _, own in pairs]), "s"),
    ]
    ratios = [
        forest(f"compared-{name}", _title(name), rows, [_ratios(groups, measure)])
        for name, measure in MEASURES.items()
    ]
    return [forest("compared-correct", "correct", rows, shares, share=True), *ratios]


def _title(measure: str) -> str:
    return f"{in_words(measure)}, ratio"


def _groups(records: Iterable[TrialRecord]) -> dict[str, list[Pair]]:
    """The pairs of both robots by scenario or level."""
    waiting: dict[tuple[str, str], dict[str, Outline]] = {}
    for record in records:
        key = (place(record.scenario, record.level), record.pair)
        waiting.setdefault(key, {})[record.robot] = Outline(record)
    groups: dict[str, list[Pair]] = {}
    for (name, _), own in waiting.items():
        if INTENTIONAL in own and BASELINE in own:
            groups.setdefault(name, []).append((own[INTENTIONAL], own[BASELINE]))
    return groups


def _ratios(groups: Mapping[str, list[Pair]], measure: Callable[[Outline], float]) -> Series:
    def estimate(pairs: list[Pair]) -> Estimate | None:
        ended = [(base, mind) for mind, base in pairs if base.ended and mind.ended]
        known = [(base, mind) for base, mind in ended if measure(mind)]
        ratios = [measure(base) / measure(mind) for base, mind in known]
        return mean([(np.array(ratios, dtype=float), 1)], [[mind.state for _, mind in known]])

    return _series("ratio", FIRST, groups, estimate)


def _share(trials: Sequence[Outline]) -> Estimate | None:
    known = [trial for trial in trials if trial.decided]
    correct = np.array([trial.correct for trial in known], dtype=float)
    return proportion([(correct, 1)], [[trial.state for trial in known]])


def _series(
    label: str,
    colour: str,
    groups: Mapping[str, list[Pair]],
    estimate: Callable[[list[Pair]], Estimate | None],
    marker: str = "o",
) -> Series:
    return Series(label, colour, tuple(_points(groups, estimate)), marker)


def _points(
    groups: Mapping[str, list[Pair]], estimate: Callable[[list[Pair]], Estimate | None]
) -> Iterator[Point]:
    for name, pairs in groups.items():
        known = estimate(pairs)
        if known is not None:
            yield estimated(name, known)
