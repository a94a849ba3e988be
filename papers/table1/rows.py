"""The published rows one by one: what in ours is like them, and what is not."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Iterator, Sequence
from statistics import fmean, median

from asp.language import literals as text
from papers.markdown import markdown, paragraph
from papers.table1 import evidence
from papers.text import percent
from testbed.studies.table1.load import Pair, Side
from testbed.studies.table1.measures import RANDOM
from testbed.studies.table1.published import MEASURES, NO_FAILURES, PUBLISHED
from testbed.studies.table1.tables import HEADINGS, number
from testbed.world import World


def row_by_row(pairs: Sequence[Pair], world: World) -> str:
    """Rows 3 and 4 by whether TP fails; plans in row 2; lengths in row 5; seconds."""
    drawn = [p for p in pairs if p.intended == RANDOM and p.played and p.decided]
    return f"""\
## Row by row

**3 and 4.** The mean of the published pairs in which TP fails follows from a row, its accuracy,
and the row without failures. Beside it ours, of the random pairs:

{markdown(("pairs", *HEADINGS), _split(drawn))}

{_parts(drawn)}

{_plans(pairs, world)}

{_ends(pairs)}

{_seconds(drawn)}
"""


def _parts(drawn: Sequence[Pair]) -> str:
    shares = "; ".join(
        f"in row {name} {_failing(drawn, name)} of our random pairs and "
        f"{percent(1 - PUBLISHED[name].baseline)} of the published ones"
        for name in ("3", "4")
    )
    return paragraph(
        "Where both parts of a row agree with ours and the row itself does not, what differs is "
        f"how large the parts are, that is, how often TP fails: {shares}.",
    )


def _failing(pairs: Sequence[Pair], scenario: str) -> str:
    """The share of a scenario's pairs in which TP fails, in percent."""
    own = [pair.base.correct for pair in pairs if pair.happened == scenario]
    return percent(own.count(False) / len(own)) if own else "none"


def _split(pairs: Sequence[Pair]) -> Iterator[tuple[str, ...]]:
    for name in ("3", "4"):
        own = [pair for pair in pairs if pair.happened == name]
        failing = [pair for pair in own if not pair.base.correct]
        others = [pair for pair in own if pair.base.correct]
        for what, theirs, ours in (
            ("TP fails", evidence.published_failures(name), failing),
            ("no failures", PUBLISHED[name + NO_FAILURES].ratios, others),
        ):
            measured = evidence.mean_ratios(ours)
            yield (f"{name}, {what}, published", *(number(theirs[m]) for m in MEASURES))
            yield (f"{name}, {what}, ours ({len(ours)})", *(number(measured[m]) for m in MEASURES))


def _plans(pairs: Sequence[Pair], world: World) -> str:
    """How many plans TP makes where what it looks for is in its place already."""
    events = [(p, p.base.event) for p in pairs if p.happened == "2" and p.base.event is not None]
    if not events:
        return "**2.** There is no such pair here."
    made = evidence.plans_made(pair for pair, _ in events).items()
    counts = ", ".join(f"{plans} plans in {count} pairs" for plans, count in made)
    last = sum(_declared_last(event, world) for _, event in events)
    return paragraph(
        f"**2.** TP made {counts}, triggered or random. It misses the book and takes it to be in "
        "one place after the other, in the order in which the domain declares them; the place "
        f"where it is comes last in {last} of these {len(events)} pairs. The published mean is "
        f"{PUBLISHED['2'].ratios['plans']:.2f} plans.",
    )


def _declared_last(event: str, world: World) -> bool:
    """Whether no event of the same kind, on the same thing, is declared behind this one."""
    kind, thing = text.name(event), text.arguments(event)[0]
    alike = [e for e in world.exogenous_actions if text.name(e) == kind]
    return [e for e in alike if text.arguments(e)[0] == thing][-1] == event


def _ends(pairs: Sequence[Pair]) -> str:
    """How long the plans were at whose end the event came, and where it took the book."""
    ended = [pair for pair in pairs if pair.happened == "5"]
    ways = {
        "triggered": [pair for pair in ended if pair.intended == "5"],
        "random": [pair for pair in ended if pair.intended == RANDOM],
    }
    needed = "; ".join(
        f"{name} {_actions(own, lambda p: p.base):.1f} and {_actions(own, lambda p: p.mind):.1f} "
        f"({len(own)} pairs; the event ends in {_places(own)})"
        for name, own in ways.items()
        if own
    )
    return paragraph(
        "**5.** How much of ATI's work TP has done when it stops depends on how long the plan was "
        "at whose end the event came, and on how long ATI has to search afterwards. TP and ATI "
        f"need so many actions on average: {needed or 'there are none'}."
    )


def _places(pairs: Sequence[Pair]) -> str:
    """Where events took what they moved, the most frequent place first."""
    events = [pair.mind.event for pair in pairs if pair.mind.event is not None]
    counts = Counter(text.arguments(event)[-1] for event in events)
    return ", ".join(f"{place} {count} times" for place, count in counts.most_common())


def _actions(pairs: Sequence[Pair], side: Callable[[Pair], Side]) -> float:
    return fmean(side(pair).measures["actions"] for pair in pairs)


def _seconds(pairs: Sequence[Pair]) -> str:
    """Why the published total time is another mixture than ours."""
    said = (
        "**Total time and planning time.** The published total time lies between the ratio of the "
        "planning times and that of the execution times: seconds of planning and units of "
        "execution were of a like size."
    )
    times = [pair.mind.measures["planning_time"] for pair in pairs]
    units = [pair.mind.measures["execution_units"] for pair in pairs]
    if times:
        said += (
            f" Here ATI plans for {1000 * median(times):.0f} ms a trial and executes "
            f"{median(units):.0f} units (medians of the random pairs)."
        )
    return paragraph(
        f"{said} What the ratio of the planning times compares is how much more this ATI computes "
        "than this TP, not the solvers of then and now.",
    )
