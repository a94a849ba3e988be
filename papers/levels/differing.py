"""Where ours differs from the published figures, and what in the records explains it."""

from __future__ import annotations

from collections.abc import Iterable, Iterator

from papers.levels import evidence
from papers.levels.commands import place
from papers.levels.evidence import Scatter
from papers.levels.growing import growth
from papers.levels.prose import times
from testbed.studies.levels import comparing
from testbed.studies.levels.comparing import CONDITIONS
from testbed.studies.levels.pairing import Trial
from testbed.studies.levels.published import FIRST, NO_ZOOM, PAPER, ZOOM
from testbed.studies.levels.runs import Run
from testbed.studies.levels.table import seconds
from testbed.text.markdown import markdown, paragraph

PLANNING = "[Performance](performance.md#zooming)"


def differences(run: Run) -> Iterator[str]:
    """How many published values lie in our intervals; the wall, the ratios, and the growth."""
    yield "## Where ours differ, and why"
    yield markdown(("", "published values", "inside our intervals"), _inside(run))
    yield from _wall(run)
    yield from _ratios(run)
    yield from growth(run)


def _inside(run: Run) -> Iterator[tuple[str, ...]]:
    tables = (
        ("trials that achieved their goal", list(comparing.shares(run.levels, PAPER))),
        ("no zoom / zoom", list(comparing.ratios(run.levels, PAPER))),
        (f"growth from {FIRST}", list(comparing.growth(run.levels, PAPER))),
    )
    for name, lines in tables:
        for what in dict.fromkeys(line.what for line in lines):
            counted = evidence.inside(line for line in lines if line.what == what)
            if counted.values:
                told = name if what == name else f"{name}, {what}"
                yield (told, str(counted.values), str(counted.inside))


def _wall(run: Run) -> Iterator[str]:
    """The levels at which the published system did not end all of its trials without zooming."""
    walled = [
        name
        for name in run.levels
        if (name, NO_ZOOM) in PAPER.conditions and PAPER.conditions[name, NO_ZOOM].completed < 1
    ]
    if not walled:
        return
    shares = [f"{_share(walled[0])} of the trials at {walled[0]}"]
    shares += [f"{_share(name)} at {name}" for name in walled[1:]]
    own = [pair.no_zoom for name in walled for pair in run.pairs.get(name, ())]
    ended = sum(trial.counts.achieved for trial in own)
    yield "### The wall without zooming"
    yield paragraph(
        f"Without zooming the published system achieved its goal in {', '.join(shares)}. Here "
        f"{ended} of {len(own)} trials at these levels did. {_slowest(run)}"
    )
    yield paragraph(
        "Here a refined plan is not solved from scratch, with zooming or without. Where it is, "
        "from the literal translation of the refined description, there is such a wall: "
        f"{PLANNING} measures both."
    )


def _share(level: str) -> str:
    return f"{PAPER.conditions[level, NO_ZOOM].completed:.0%}"


def _slowest(run: Run) -> str:
    told = []
    for trials, name in (
        ([pair.no_zoom for pair in run.all_pairs], CONDITIONS[NO_ZOOM]),
        ([pair.zoom for pair in run.all_pairs], CONDITIONS[ZOOM]),
    ):
        longest = max(trials, key=_reasoning)
        told.append(
            f"{seconds(_reasoning(longest))} ({name}; `testbed replay {place(run.config)} "
            f"--trial {longest.trial}`)"
        )
    return f"The trials with most reasoning took {' and '.join(told)}."


def _reasoning(trial: Trial) -> float:
    return trial.counts.seconds["total"]


def _ratios(run: Run) -> Iterator[str]:
    scatters = _scatters(run)
    if not scatters:
        return
    whole = evidence.met(run.all_pairs)
    yield "### The ratios"
    yield paragraph(
        f"In {whole.alike} of {whole.pairs} pairs both robots did the same: the same abstract "
        "actions at the same steps, by as many refined plans, concrete actions and tests. There a "
        "ratio compares the time of the same work. At the coarse resolution even the reasoning is "
        "the same, so that its ratio says how well times can be compared. Of these pairs:"
    )
    yield markdown(
        (
            "level",
            "pairs",
            "coarse, no zoom / zoom",
            "zoom / no zoom",
            "median",
            "median, zoom first",
            "median, no zoom first",
        ),
        (_scatter(name, own) for name, own in scatters.items()),
    )
    yield paragraph(_scattered(scatters.values()))
    refined = [(n, level.compared.ratios["refined_plan"].median) for n, level in run.levels.items()]
    known = [(name, estimate.value) for name, estimate in refined if estimate is not None]
    least, most = min(known, key=lambda own: own[1]), max(known, key=lambda own: own[1])
    yield paragraph(
        f"What zooming is worth is thus seen at the fine resolution: a refined plan takes "
        f"{times(least[1])} ({least[0]}) to {times(most[1])} ({most[0]}) times as long without "
        "it, by the medians. What it is worth where plans are solved from scratch, and why it is "
        f"less here, says {PLANNING}."
    )


def _scatters(run: Run) -> dict[str, Scatter]:
    found = {name: evidence.scatter(own, run.config.robots) for name, own in run.pairs.items()}
    return {name: own for name, own in found.items() if own is not None}


def _scatter(name: str, own: Scatter) -> tuple[str, ...]:
    medians = (own.median, own.zoom_first, own.no_zoom_first)
    return (name, str(own.pairs), times(own.mean), times(own.inverse), *map(times, medians))


def _scattered(scatters: Iterable[Scatter]) -> str:
    own = list(scatters)
    both = sum(one.mean > 1 and one.inverse > 1 for one in own)
    medians = [one.median for one in own]
    split = [(o.zoom_first, o.no_zoom_first) for o in own]
    gained = sum(z is not None and n is not None and z < n for z, n in split)
    served = 2 * gained > len(own)
    return (
        f"At {both} of {len(own)} levels the mean is above 1 whichever of the two is divided by "
        "the other: scatter alone raises a mean of ratios. The medians lie between "
        f"{times(min(medians))} and {times(max(medians))}. At {gained} of {len(own)} levels the "
        "robot that plays second needs less time, by these medians"
        f"{': what the first has prepared can serve it, too' if served else ''}. Which of a pair "
        "is first is drawn with its seed."
    )
