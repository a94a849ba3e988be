"""The published rows one by one: what in ours is like them, and what is not."""

from collections import Counter
from collections.abc import Callable, Iterator, Sequence
from statistics import fmean, median
from typing import Any

from asp.language import Action
from papers.table1 import evidence
from papers.table1.pairs import Pair, Side
from papers.text import render
from testbed.studies.table1.measures import RANDOM
from testbed.studies.table1.published import MEASURES, NO_FAILURES, PUBLISHED
from testbed.studies.table1.tables import HEADINGS
from testbed.text import number
from testbed.world import World


def row_by_row(pairs: Sequence[Pair], world: World) -> str:
    """Rows 3 and 4 by whether TP fails; plans in row 2; lengths in row 5; seconds."""
    drawn = [p for p in pairs if p.intended == RANDOM and p.played and p.decided]
    failing = [(n, _failing(drawn, n), 1 - PUBLISHED[n].baseline) for n in ("3", "4")]
    return render(
        "table1/rows",
        headings=HEADINGS,
        split=list(_split(drawn)),
        failing=failing,
        ends=list(_ends(pairs)),
        **_plans(pairs, world),
        **_medians(drawn),
    )


def _failing(pairs: Sequence[Pair], scenario: str) -> float | None:
    """The share of a scenario's pairs in which TP fails; None without any."""
    own = [pair.baseline.correct for pair in pairs if pair.happened == scenario]
    return own.count(False) / len(own) if own else None


def _split(pairs: Sequence[Pair]) -> Iterator[tuple[str, ...]]:
    for name in ("3", "4"):
        own = [pair for pair in pairs if pair.happened == name]
        failing = [pair for pair in own if not pair.baseline.correct]
        others = [pair for pair in own if pair.baseline.correct]
        for what, theirs, ours in (
            ("TP fails", evidence.published_failures(name), failing),
            ("no failures", PUBLISHED[name + NO_FAILURES].ratios, others),
        ):
            measured = evidence.mean_ratios(ours)
            yield (f"{name}, {what}, published", *(number(theirs[m]) for m in MEASURES))
            yield (f"{name}, {what}, ours ({len(ours)})", *(number(measured[m]) for m in MEASURES))


def _plans(pairs: Sequence[Pair], world: World) -> dict[str, Any]:
    """How many plans TP makes where what it looks for is in its place already."""
    events = [
        (p, p.baseline.event) for p in pairs if p.happened == "2" and p.baseline.event is not None
    ]
    return {
        "events": len(events),
        "made": list(evidence.plans_made(pair for pair, _ in events).items()),
        "last": sum(_declared_last(event, world) for _, event in events),
        "published_plans": PUBLISHED["2"].ratios["plans"],
    }


def _declared_last(event: Action, world: World) -> bool:
    """Whether no event of the same kind, on the same thing, is declared behind this one."""
    kind, thing = event.name, event.arguments[0]
    alike = [e for e in world.exogenous_actions if e.name == kind]
    return [e for e in alike if e.arguments[0] == thing][-1] == event


def _ends(pairs: Sequence[Pair]) -> Iterator[dict[str, Any]]:
    """How long the plans were at whose end the event came, and where it took the book."""
    ended = [pair for pair in pairs if pair.happened == "5"]
    for name, intended in (("triggered", "5"), ("random", RANDOM)):
        own = [pair for pair in ended if pair.intended == intended]
        if own:
            yield {
                "name": name,
                "pairs": len(own),
                "base": _actions(own, lambda pair: pair.baseline),
                "mind": _actions(own, lambda pair: pair.treatment),
                "places": _places(own),
            }


def _places(pairs: Sequence[Pair]) -> list[tuple[str, int]]:
    """Where events took what they moved, the most frequent place first."""
    events = [pair.treatment.event for pair in pairs if pair.treatment.event is not None]
    return Counter(event.arguments[-1] for event in events).most_common()


def _actions(pairs: Sequence[Pair], side: Callable[[Pair], Side]) -> float:
    return fmean(side(pair).measures["actions"] for pair in pairs)


def _medians(pairs: Sequence[Pair]) -> dict[str, float | None]:
    """Seconds of planning and units of execution of ATI; None without any pair."""
    times = [pair.treatment.measures["planning_time"] for pair in pairs]
    units = [pair.treatment.measures["execution_units"] for pair in pairs]
    return {"seconds": median(times) if times else None, "units": median(units) if units else None}
