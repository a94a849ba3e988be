"""Where ours differs from the published figures, and what in the records explains it."""

from collections.abc import Iterator, Mapping
from typing import Any

from papers.levels import evidence
from papers.levels.evidence import Scatter, Surprise, Work
from papers.levels.pairing import Trial
from papers.levels.runs import Run
from testbed.studies.levels.published import FIRST, NO_ZOOM, PAPER, ZOOM
from testbed.studies.levels.tables import CONDITIONS, RATIO, ratios, seconds, shares
from testbed.studies.levels.tables import growth as grown
from testbed.text import number


def differences(run: Run) -> dict[str, Any]:
    """How many published values lie in our intervals; the wall, and the ratios."""
    return {"inside": list(_inside(run)), **_wall(run), **_ratios(run)}


def _inside(run: Run) -> Iterator[tuple[str, ...]]:
    tables = (
        ("trials that achieved their goal", list(shares(run.beside))),
        (RATIO, list(ratios(run.beside))),
        (f"growth from {FIRST}", list(grown(run.beside))),
    )
    for name, rows in tables:
        for what in dict.fromkeys(row.what for row in rows):
            counted = evidence.inside(row for row in rows if row.what == what)
            if counted.values:
                told = name if what == name else f"{name}, {what}"
                yield (told, str(counted.values), str(counted.inside))


def _wall(run: Run) -> dict[str, Any]:
    """The levels at which the published system did not end all of its trials without zooming."""
    known = {name: PAPER.conditions.get((name, NO_ZOOM)) for name in run.levels}
    walled = [(name, own.completed) for name, own in known.items() if own and own.completed < 1]
    own = [pair.no_zoom for name, _ in walled for pair in run.pairs.get(name, ())]
    return {
        "walled": walled,
        "wall": {"ended": sum(trial.achieved for trial in own), "trials": len(own)},
        "slowest": [
            _slowest([pair.no_zoom for pair in run.all_pairs], NO_ZOOM),
            _slowest([pair.zoom for pair in run.all_pairs], ZOOM),
        ],
    }


def _slowest(trials: list[Trial], robot: str) -> dict[str, str]:
    longest = max(trials, key=_reasoning)
    told = seconds(_reasoning(longest))
    return {"seconds": told, "condition": CONDITIONS[robot], "trial": longest.trial}


def _reasoning(trial: Trial) -> float:
    return trial.seconds["total"]


def _ratios(run: Run) -> dict[str, Any]:
    """What comparing two clocks comes to where both robots do the same; nothing where none do."""
    found = {name: evidence.scatter(own, run.config.robots) for name, own in run.pairs.items()}
    scatters = {name: own for name, own in found.items() if own is not None}
    if not scatters:
        return {"scatters": []}
    refined = [(n, level.compared.ratios["refined_plan"].median) for n, level in run.levels.items()]
    known = [(name, estimate.value) for name, estimate in refined if estimate is not None]
    own = list(scatters.values())
    split = [(one.zoom_first, one.no_zoom_first) for one in own]
    return {
        "scatters": [_scatter(name, one) for name, one in scatters.items()],
        "scatter": {
            "levels": len(own),
            "both": sum(one.mean > 1 and one.inverse > 1 for one in own),
            "least": min(one.median for one in own),
            "most": max(one.median for one in own),
            "gained": sum(z is not None and n is not None and z < n for z, n in split),
        },
        "least": min(known, key=lambda one: one[1]),
        "most": max(known, key=lambda one: one[1]),
    }


def _scatter(name: str, own: Scatter) -> tuple[str, ...]:
    medians = (own.median, own.zoom_first, own.no_zoom_first)
    return (name, str(own.pairs), number(own.mean), number(own.inverse), *map(number, medians))


def growth(run: Run) -> dict[str, Any]:
    """How many plans and how long each, at the fine resolution; what surprises cost at the other.

    Nothing where the first level was not played, or no other.
    """
    if FIRST not in run.pairs or len(run.pairs) == 1:
        return {"work": []}
    works = {name: evidence.work(own, name, PAPER) for name, own in run.pairs.items()}
    calm = {name: evidence.surprise(own) for name, own in run.pairs.items()}
    first, last = works[FIRST], list(works.values())[-1]
    return {
        "last": list(works)[-1],
        "work": [_work(name, own, first) for name, own in works.items()],
        "plans_each": [_divided(own.plans, own.abstract) for own in (first, last)],
        "grown": {
            "ours": _larger(
                _divided(last.plans, first.plans), _divided(last.seconds, first.seconds)
            ),
            "theirs": _larger(
                _divided(last.implied, first.implied), _divided(last.published, first.published)
            ),
        },
        "surprise": [_surprise(name, own, calm[FIRST]) for name, own in calm.items()],
        "surprised": _surprised(calm),
    }


def _work(name: str, own: Work, first: Work) -> tuple[str, ...]:
    return (
        name,
        f"{own.abstract:.1f}",
        f"{own.plans:.1f}",
        "-" if own.implied is None else f"{own.implied:.1f}",
        number(_divided(own.plans, first.plans)),
        number(_divided(own.implied, first.implied)),
        number(_divided(own.seconds, first.seconds)),
        number(_divided(own.published, first.published)),
    )


def _divided(above: float | None, below: float | None) -> float | None:
    return above / below if above is not None and below else None


def _larger(plans: float | None, time: float | None) -> str | None:
    """What grows more."""
    if plans is None or time is None:
        return None
    return "the number of plans" if plans > time else "the time of a plan"


def _surprise(name: str, own: Surprise, first: Surprise) -> tuple[str, ...]:
    published = PAPER.growth(name, ZOOM, "coarse")
    return (
        name,
        f"{own.events:.1f}",
        f"{own.calm} of {own.trials}",
        number(_divided(own.seconds, first.seconds)),
        "-" if published is None else number(published.value),
        number(_divided(own.others, own.seconds)),
    )


def _surprised(levels: Mapping[str, Surprise]) -> dict[str, Any] | None:
    """At the last level, the trials with something to explain, and their share of the time."""
    last = list(levels.values())[-1]
    if last.seconds is None or last.others is None:
        return None
    explaining = last.trials - last.calm
    part = last.others * explaining
    return {"trials": explaining, "share": part / (part + last.seconds * last.calm)}
