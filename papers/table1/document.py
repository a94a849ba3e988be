"""`docs/published-and-measured.md`: both tables beside the published one, and what explains it."""

from collections.abc import Iterator

from papers.table1.commands import Sources, commands, played
from papers.table1.drawing import drawing
from papers.table1.failing import blindness, failures, meetings
from papers.table1.hypotheses import Hypothesis, compared, hypotheses
from papers.table1.measured import optimum, times
from papers.table1.others import heeding, later, unaided
from papers.table1.pairs import Pair
from papers.table1.parts import part_of
from papers.table1.rows import row_by_row
from papers.table1.runs import Run, told_order
from papers.text import render
from testbed.experiment import StoreError
from testbed.experiment.digest import digest
from testbed.experiment.plan import coverage_of, places_of
from testbed.experiment.store import read_records
from testbed.studies import rows_of
from testbed.studies.table1.measures import RANDOM, Analysis, Table
from testbed.studies.table1.tables import HEADINGS, lines, population, test_rows
from testbed.world import load_world

TITLES = {
    "triggered": "Triggered scenarios",
    "random": "Random exogenous actions, classified afterwards",
}
COLUMNS = ("scenario", "pairs", *HEADINGS, "TP acc.", "ATI acc.")
__all__ = ["Sources", "document"]


def document(sources: Sources) -> str:
    """The page as Markdown: the tables, then a section a question, the tests last."""
    mind = sources.main.minds[0]
    analysis, pairs = sources.main.analyses[mind], sources.main.pairs[mind]
    runs = [*played(sources), *sources.told]
    sections = [
        times(analysis),
        drawing(analysis),
        blindness(pairs),
        row_by_row(pairs, load_world(sources.main.config.domain)),
        *_hypotheses(sources, mind),
        *([] if sources.later is None else [later(sources.later, pairs)]),
        optimum(analysis),
        failures(sources.main, mind),
        meetings(pairs),
        *([] if sources.unaided is None else [unaided(sources.unaided)]),
        *([] if sources.heeding is None else [heeding(sources.heeding, sources.main)]),
        _tests(analysis),
    ]
    return render(
        "table1/page",
        commands=commands(sources),
        digests=[
            (f"`runs/{run.config.name}`", f"`{digest(read_records(run.folder))}`") for run in runs
        ],
        incomplete=[(run.config.name, own) for run in runs if (own := _notice(run)) is not None],
        columns=COLUMNS,
        tables=[
            (TITLES[name], rows_of(lines(table)), _population(table), _apart(table))
            for name, table in analysis.tables.items()
        ],
        sections=sections,
    )


def _notice(run: Run) -> str | None:
    return coverage_of(places_of(run.folder), run.config).notice()


def _tests(analysis: Analysis) -> str:
    """Effect sizes and corrected p-values of both tables."""
    tables = [
        (name.capitalize(), list(test_rows(table))) for name, table in analysis.tables.items()
    ]
    return render("table1/tests", tables=tables, headings=HEADINGS)


def _hypotheses(sources: Sources, mind: str) -> Iterator[str]:
    """What random pairs would come to otherwise, where there are any."""
    main = sources.main
    if "random" not in main.analyses[mind].tables:
        return
    found = hypotheses(main.pairs[mind], main.config.goal)
    if sources.later is not None:
        own = part_of(sources.later.pairs[mind])
        found.append(Hypothesis(f"rate {sources.later.config.adversary.rate}", own))
    for run in sources.variants:
        found.append(Hypothesis(run.config.name, part_of(run.pairs[mind])))
    for run in sources.told:
        name = ", ".join(("told", *told_order(run)))
        found.append(Hypothesis(name, part_of(_of(main, run, mind))))
    yield compared(found, bool(sources.variants), bool(sources.told))


def _of(main: Run, run: Run, mind: str) -> list[Pair]:
    """The pairs of a run whose other robot met the same as in the main run."""
    known = {pair.treatment.trial for pair in main.pairs[mind] if pair.intended == RANDOM}
    if any(pair.treatment.trial not in known for pair in run.pairs[mind]):
        raise StoreError(f"{run.folder}: its pairs are not those of {main.folder}")
    return run.pairs[mind]


def _apart(table: Table) -> str:
    """How many pairs are in no row, and why."""
    apart = [f"{count} pairs: {name}" for name, count in table.apart.items()]
    everything = [row for row in table.rows if row.name.isdigit()]
    left_out = (
        ("trials in error or without a robot", "failed"),
        ("decisions cut off by the clock", "deadline"),
        ("goal out of reach from the start", "unsolvable"),
    )
    counts = [(name, sum(row.left_out[key] for row in everything)) for name, key in left_out]
    counts.append(("goal out of reach at the end", sum(row.out_of_reach for row in everything)))
    return "; ".join([*apart, *(f"{name}: {count}" for name, count in counts)])


def _population(table: Table) -> str:
    """Why some rows have no interval; "" where all have one."""
    whole = [row.name for row in table.rows if row.whole]
    return f"{population(whole)}." if whole else ""
