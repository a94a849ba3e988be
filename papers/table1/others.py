"""Runs under other rules: without goal feedback, with later events, with another relevance."""

from collections import Counter
from collections.abc import Iterator, Mapping, Sequence
from statistics import fmean

from papers.table1 import evidence
from papers.table1.failing import by_row
from papers.table1.pairs import Pair
from papers.table1.runs import Run
from papers.text import percent, render
from testbed.analysis.comparison import Apart
from testbed.studies.table1.measures import RANDOM, Row
from testbed.studies.table1.published import MEASURES, PUBLISHED
from testbed.studies.table1.tables import HEADINGS
from testbed.studies.tables import Cell
from testbed.text import number
from testbed.world import load_world

EFFORT = ("plans", "actions", "execution_units")
"""What a trial takes whatever the machine."""


def later(run: Run, main: Sequence[Pair]) -> str:
    """The same random pairs with events that come later than in the main run.

    With how often the event comes beside the first action, and by which probability.
    """
    table = run.analyses[run.minds[0]].tables.get("random")
    if table is None:
        return ""
    came = [
        len(p.treatment.before) == 1 for p in main if p.intended == RANDOM and p.treatment.event
    ]
    triggers = load_world(run.config.domain).description.triggers
    published, _ = evidence.published_weights()
    return render(
        "table1/later",
        stated=min(t.probability for t in triggers if t.scenario == RANDOM),
        often=sum(came) / len(came) if came else None,
        rate=run.config.adversary.rate,
        headings=HEADINGS,
        rows=[_accuracy(row) for row in table.rows if row.name in PUBLISHED and row.pairs],
        shares=_shares(evidence.shares(table)),
        published=_shares(published),
    )


def _shares(shares: Mapping[str, float]) -> str:
    return ", ".join(f"{name}: {percent(share)}" for name, share in shares.items())


def _accuracy(row: Row) -> tuple[str, ...]:
    ours = Cell(row.baseline, share=True).value.whole
    ratios = [row.ratios[name].mean for name in MEASURES]
    values = (number(None if ratio is None else ratio.value) for ratio in ratios)
    return (row.name, str(row.pairs), ours, percent(PUBLISHED[row.name].baseline), *values)


def unaided(run: Run) -> str:
    """Accuracies without goal feedback, by robot; what the others needed beside the first."""
    first, *others = run.minds
    units = {
        m: sum(p.treatment.measures["execution_units"] for p in run.pairs[m]) for m in run.minds
    }
    return render(
        "table1/unaided",
        minds=run.minds,
        rows=list(_achieved(run)),
        apart=sorted(Counter(_reasons(run).values()).items()),
        always=all(pair.treatment.achieved for pair in run.pairs[first]),
        costs=[(name, units[name] / units[first]) for name in others if units[first]],
    )


def _achieved(run: Run) -> Iterator[tuple[str, ...]]:
    """By the scenario of the first robot, for its pairs and those of the others beside them."""
    first, reasons = run.minds[0], _reasons(run)
    counted = [p for p in run.pairs[first] if p.baseline.trial not in reasons]
    places = {pair.baseline.trial: _place(pair) for pair in counted}
    for name in sorted(set(places.values())):
        own = {
            m: [p for p in run.pairs[m] if places.get(p.baseline.trial) == name] for m in run.minds
        }
        minds = (_share([pair.treatment.achieved for pair in own[m]]) for m in run.minds)
        base = _share([pair.baseline.achieved for pair in own[first]])
        yield (name, str(len(own[first])), *minds, base)


def _reasons(run: Run) -> dict[str, str]:
    """Why pairs are in no row, by the baseline's trial: no event, or nothing to do."""
    own, told = run.pairs[run.minds[0]], (Apart.WITHOUT_EVENT, Apart.NOTHING_TO_DO)
    return {pair.baseline.trial: pair.apart for pair in own if pair.apart in told}


def _place(pair: Pair) -> str:
    return f"random, {pair.happened}" if pair.intended == RANDOM else f"triggered, {pair.intended}"


def _share(right: Sequence[bool]) -> str:
    return f"{100 * sum(right) / len(right):.1f}% ({sum(right)})" if right else "-"


def heeding(run: Run, main: Run) -> str:
    """The rows in which the treatment does otherwise with another `relevance`."""
    ours, others = (by_row(own.pairs[own.minds[0]]) for own in (main, run))
    rows = {name: (_effort(ours.get(name, ())), _effort(others[name])) for name in others}
    changed = [name for name, (before, after) in rows.items() if before != after]
    return render(
        "table1/heeding",
        relevance=run.config.relevance,
        usual=main.config.relevance,
        rows=[(name, main.config.relevance, *rows[name][0]) for name in changed]
        + [(name, run.config.relevance, *rows[name][1]) for name in changed],
        same=len(others) - len(changed),
        alike=sum(len(others[name]) for name in others if name not in changed),
    )


def _effort(pairs: Sequence[Pair]) -> tuple[str, ...]:
    """How many pairs, in how many trials the treatment achieved its goal, what it needed."""
    own = [pair.treatment for pair in pairs]
    means = (fmean(side.measures[name] for side in own) if own else None for name in EFFORT)
    return (str(len(own)), _share([side.achieved for side in own]), *map(number, means))
