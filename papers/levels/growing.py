"""Why times grow otherwise from level to level than the published ones."""

from __future__ import annotations

from collections.abc import Iterator, Mapping

from papers.levels import evidence
from papers.levels.evidence import Surprise, Work
from papers.levels.prose import times
from testbed.studies.levels.published import FIRST, PAPER, ZOOM
from testbed.studies.levels.runs import Run
from testbed.text.markdown import markdown, paragraph

WORK = (
    "level",
    "abstract actions",
    "refined plans",
    "would fill the published time",
    f"plans / {FIRST}",
    "published",
    f"time of one / {FIRST}",
    "published",
)
SURPRISE = (
    "level",
    "exogenous actions",
    "trials that explain nothing",
    f"their coarse time / {FIRST}",
    "published, all trials",
    "that of the others / theirs",
)


def growth(run: Run) -> Iterator[str]:
    """How many plans and how long each, at the fine resolution; what surprises cost at the other.

    Nothing where the first level was not played, or no other.
    """
    if FIRST not in run.pairs or len(run.pairs) == 1:
        return
    yield "### The growth"
    works = {name: evidence.work(own, name, PAPER) for name, own in run.pairs.items()}
    yield paragraph(
        "With zooming, the time at the fine resolution is made of refined plans, how many and how "
        "long each takes. The published tables have no number of plans; their time at the fine "
        "resolution, divided by that of one plan, says how many would fill it. Of trials with "
        "zooming:"
    )
    yield markdown(WORK, (_work(name, own, works[FIRST]) for name, own in works.items()))
    yield paragraph(_grown(works))
    calm = {name: evidence.surprise(own) for name, own in run.pairs.items()}
    yield paragraph(
        "At the coarse resolution it matters whether something has to be explained. Others act "
        "while the robot does, so that a longer trial meets more of them. Of trials with zooming:"
    )
    yield markdown(SURPRISE, (_surprise(name, own, calm[FIRST]) for name, own in calm.items()))
    yield paragraph(_surprised(calm))


def _work(name: str, own: Work, first: Work) -> tuple[str, ...]:
    return (
        name,
        f"{own.abstract:.1f}",
        f"{own.plans:.1f}",
        "-" if own.implied is None else f"{own.implied:.1f}",
        times(_divided(own.plans, first.plans)),
        times(_divided(own.implied, first.implied)),
        times(_divided(own.seconds, first.seconds)),
        times(_divided(own.published, first.published)),
    )


def _divided(above: float | None, below: float | None) -> float | None:
    return above / below if above is not None and below else None


def _grown(works: Mapping[str, Work]) -> str:
    """What grows more in ours and in theirs, at the last level."""
    name, last, first = list(works)[-1], list(works.values())[-1], works[FIRST]
    text = (
        f"At {name} an abstract action takes {times(_divided(last.plans, last.abstract))} refined "
        f"plans, at {FIRST} {times(_divided(first.plans, first.abstract))}: a new one is made "
        "where an action or a test failed, or an object was not where the plan assumed it "
        "([Execution](execution.md)). "
    )
    ours = _larger(_divided(last.plans, first.plans), _divided(last.seconds, first.seconds))
    theirs = _larger(
        _divided(last.implied, first.implied), _divided(last.published, first.published)
    )
    if ours is None or theirs is None:
        return text
    if ours == theirs:
        return text + f"From there on {ours} grows more, here and in the published system."
    return text + f"From there on {ours} grows more here, and {theirs} in the published system."


def _larger(plans: float | None, time: float | None) -> str | None:
    if plans is None or time is None:
        return None
    return "the number of plans" if plans > time else "the time of a plan"


def _surprise(name: str, own: Surprise, first: Surprise) -> tuple[str, ...]:
    published = PAPER.growth(name, ZOOM, "coarse")
    return (
        name,
        f"{own.events:.1f}",
        f"{own.calm} of {own.trials}",
        times(_divided(own.seconds, first.seconds)),
        "-" if published is None else times(published.value),
        times(_divided(own.others, own.seconds)),
    )


def _surprised(levels: Mapping[str, Surprise]) -> str:
    name, last = list(levels)[-1], list(levels.values())[-1]
    if last.seconds is None or last.others is None:
        return ""
    part = last.others * (last.trials - last.calm)
    share = part / (part + last.seconds * last.calm)
    return (
        f"At {name} the {last.trials - last.calm} trials with something to explain have "
        f"{share:.0%} of all coarse reasoning."
    )
