"""Runs under other rules: without goal feedback, and with events that come later."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator, Sequence

from papers.markdown import markdown, paragraph
from papers.table1 import evidence
from papers.table1.runs import Run
from papers.text import percent
from testbed.analysis.counting import NO_EVENT, NOTHING_TO_DO, Apart, eventful
from testbed.experiment.domains import load_world
from testbed.studies.table1.load import Pair
from testbed.studies.table1.measures import RANDOM, Row
from testbed.studies.table1.published import MEASURES, PUBLISHED
from testbed.studies.table1.tables import HEADINGS, number
from testbed.studies.tables import written


def later(run: Run, main: Sequence[Pair]) -> str:
    """The same random pairs with events that come later than in the main run."""
    table = run.analyses[run.minds[0]].random
    if table is None:
        return ""
    columns = ("scenario", "pairs", "TP acc.", "published", *HEADINGS)
    rows = [_accuracy(row) for row in table.rows if row.name in PUBLISHED and row.pairs]
    shares = ", ".join(f"{name}: {percent(s)}" for name, s in evidence.shares(table).items())
    published, _ = evidence.published_weights()
    weights = ", ".join(f"{name}: {percent(s)}" for name, s in published.items())
    return f"""\
## If random events came later

{_first(main, run)}

{markdown(columns, rows)}

Shares of the scenarios 1 to 5: {shares}; published {weights}.
"""


def _first(main: Sequence[Pair], run: Run) -> str:
    """How often the event comes beside the first action, and by which probability."""
    came = [len(p.mind.before) == 1 for p in main if p.intended == RANDOM and p.mind.event]
    triggers = load_world(run.config.domain).description.triggers
    stated = min(t.probability for t in triggers if t.scenario == RANDOM)
    often = percent(sum(came) / len(came)) if came else "none"
    return paragraph(
        f"A random event is tried with probability {stated} at each action, as in the released "
        f"simulator: in {often} of the pairs that have one it comes beside the first, when nothing "
        "that the robot delivered can be undone yet. How much depends on that is seen with "
        f"{run.config.adversary.rate} in its place, all else being equal. This is no attempt at "
        "agreement; the tables above stand. The shares of the scenarios, beside those that the "
        "published rows ask for, say whether later events could be what the published table is "
        "made of:"
    )


def _accuracy(row: Row) -> tuple[str, ...]:
    ours = "-" if row.baseline is None else written(row.baseline, share=True)
    ratios = [row.ratios[name].mean for name in MEASURES]
    values = (number(None if ratio is None else ratio.value) for ratio in ratios)
    return (row.name, str(row.pairs), ours, percent(PUBLISHED[row.name].baseline), *values)


def unaided(run: Run) -> str:
    """Accuracies without goal feedback, by robot."""
    columns = ("scenario", "pairs", *run.minds, "traditional")
    return f"""\
## Without goal feedback

A robot that finishes is not told that the goal does not hold. ATI believes that its goal holds as
long as nothing that it has seen says otherwise, which is wrong where something delivered was taken
away behind its back; `intentional-checking` goes to look before it finishes. The trials whose goal
is achieved:

{markdown(columns, _achieved(run))}
{_apart(run)}
{_why(run)}The scenario is the one that was played, or, of a random event, what it came to be for
the first of these robots. Where that one ends wrongly after all of its one activity, it is scenario
1 by the rule.

{_costs(run)}"""


def _why(run: Run) -> str:
    """What there is to say where the first robot fails in no trial."""
    if not all(pair.mind.achieved for pair in run.pairs[run.minds[0]]):
        return ""
    return (
        "ATI does without feedback here: it ends in the room that its goal is about, and sees\n"
        "all of the goal when it finishes; or it infers the rest, which is right as long as there\n"
        "is at most one exogenous action in a trial. Of several it could miss one.\n\n"
    )


def _achieved(run: Run) -> Iterator[tuple[str, ...]]:
    """By the scenario of the first robot, for its pairs and those of the others beside them."""
    first, reasons = run.minds[0], _reasons(run)
    counted = [p for p in run.pairs[first] if p.base.trial not in reasons]
    places = {pair.base.trial: _place(pair) for pair in counted}
    for name in sorted(set(places.values())):
        own = {m: [p for p in run.pairs[m] if places.get(p.base.trial) == name] for m in run.minds}
        minds = (_share([pair.mind.achieved for pair in own[m]]) for m in run.minds)
        base = _share([pair.base.achieved for pair in own[first]])
        yield (name, str(len(own[first])), *minds, base)


def _reasons(run: Run) -> dict[str, Apart]:
    """Why pairs are in no row, by the baseline's trial: no event, or nothing to do."""
    sure = eventful(run.config)
    reasons = {pair.base.trial: pair.apart(sure) for pair in run.pairs[run.minds[0]]}
    return {t: reason for t, reason in reasons.items() if reason in (NO_EVENT, NOTHING_TO_DO)}


def _apart(run: Run) -> str:
    counts = sorted(Counter(_reasons(run).values()).items())
    told = "; ".join(f"{count} pairs: {reason}" for reason, count in counts)
    return f"\nCounted apart: {told}.\n" if told else ""


def _place(pair: Pair) -> str:
    return f"random, {pair.happened}" if pair.intended == RANDOM else f"triggered, {pair.intended}"


def _share(right: Sequence[bool]) -> str:
    return f"{100 * sum(right) / len(right):.1f}% ({sum(right)})" if right else "-"


def _costs(run: Run) -> str:
    """How many times the units of the first robot the others needed, over all pairs."""
    first, *others = run.minds
    units = {m: sum(p.mind.measures["execution_units"] for p in run.pairs[m]) for m in run.minds}
    return "".join(
        f"Over all pairs `{name}` needed {units[name] / units[first]:.2f} times the execution "
        f"units of `{first}`.\n"
        for name in others
        if units[first]
    )
