"""Table 1 beside the published one, for the terminal and the report."""

from collections.abc import Iterable, Iterator, Sequence
from itertools import chain
from pathlib import Path

from testbed.analysis.comparison import LEAST
from testbed.analysis.pairs import Compared
from testbed.experiment.timeline import in_words
from testbed.studies.charts import Chart, Key, Series, points, published
from testbed.studies.study import Section
from testbed.studies.table1.measures import Analysis, Row, Table
from testbed.studies.table1.pairs import MEETINGS
from testbed.studies.table1.published import MEASURES, PLANNING, PUBLISHED
from testbed.studies.tables import Cell, Cells, Line, Rounded, Sheet, View, effect
from testbed.text import counted, listed, number

HEADINGS = ("total time", "plans", "planning time", "exec. time", "actions")
"""The published names of the measures."""
ROBOTS = {"baseline": "TP correct", "treatment": "ATI correct"}
COLUMNS = ("scenario", "pairs", *HEADINGS, *ROBOTS.values())
TIMES = ("scenario", "time", "TP", "ATI", "mean of ratios", "ratio of sums", "published")
DISTANCES = ("trials", "units", "actions")
OPTIMUM = ("scenario", *(f"{robot} {what}" for robot in ("TP", "ATI") for what in DISTANCES))
READINGS = (PLANNING, "reasoning_time")
"""What the published planning time can mean: planning alone, or all reasoning."""
WAYS = {"triggered": "triggered", "random": "drawn at random, classified"}
"""How scenarios are drawn."""
NOT_COUNTED = {
    "failed": "with a lost trial",
    "deadline": "with a decision cut off by the clock",
    "unsolvable": "whose goal no plan achieves",
}
LEGEND = (
    Key("interval", "first", "triggered, with its 95% interval"),
    Key("square", "second", "drawn at random, classified by what happened"),
)


def sections(analyses: Iterable[Analysis]) -> list[Section]:
    """A section for each robot that is compared with the traditional one."""
    return [_section(own) for own in analyses if own.tables]


def _section(own: Analysis) -> Section:
    paper = any(table.published for table in own.tables.values())
    return Section(
        name=f"table1-{own.robots.treatment}",
        title=f"Table 1: {own.robots.treatment} against {own.robots.baseline}",
        views=[_view(own, name, table) for name, table in own.tables.items()],
        charts=charts(own),
        legend=(*LEGEND, *[Key("published", "paper", "published")] * paper),
        sheets=[_became(own)],
        template=Path(__file__).with_name("section.html.j2"),
        values={"robot": own.robots.treatment, "paper": paper},
    )


def _view(own: Analysis, name: str, table: Table) -> View:
    tests = ("scenario", *HEADINGS, "correct")
    times, distances = list(times_rows(table)), list(optimum_rows(table, own.robots))
    return View(
        name=f"table1-{own.robots.treatment}-{name}",
        title=f"Scenarios {WAYS[name]}",
        columns=COLUMNS,
        lines=lines(table),
        notes=tuple(_notes(table)),
        sheets=(
            Sheet("Effect sizes and tests", tests, list(test_rows(table))),
            _without_empty(Sheet("Planning, diagnosis and both", TIMES, times, 2)),
            Sheet("How far from the optimum", OPTIMUM, distances),
        ),
    )


def _without_empty(sheet: Sheet) -> Sheet:
    """Without the last column, of published values, where there are none."""
    if any(row[-1] for row in sheet.rows):
        return sheet
    return Sheet(sheet.title, sheet.columns[:-1], [row[:-1] for row in sheet.rows], sheet.names)


def _became(own: Analysis) -> Sheet:
    kinds = sorted({kind for counts in own.became.values() for kind in counts})
    rows = [
        (name, *(str(counts.get(kind, "")) for kind in kinds))
        for name, counts in own.became.items()
    ]
    return Sheet("What the scenarios that were played came to be", ("played", *kinds), rows)


def lines(table: Table) -> list[Line]:
    """The rows with pairs, each with its ratios and accuracies."""
    return [
        Line((row.name, str(row.pairs)), tuple(cell.value for cell in cells(table, row).values()))
        for row in table.rows
        if row.pairs
    ]


def cells(table: Table, row: Row) -> dict[str, Cell]:
    """By measure, then by robot, ours beside the published values."""
    paper = table.published.get(row.name)
    return {
        name: Cell(own.mean, own.median, Rounded(paper.ratios[name]) if paper else None)
        for name, own in row.ratios.items()
    } | {
        who: Cell(
            getattr(row, who), None, Rounded(getattr(paper, who)) if paper else None, share=True
        )
        for who in ROBOTS
    }


def test_rows(table: Table) -> Iterator[Cells]:
    """For each row the effect sizes, with the p-values after Holm's correction."""
    for row in table.rows:
        if row.pairs:
            yield (row.name, *(effect(row.ratios[name].test) for name in MEASURES), _right(row))


def _right(row: Row) -> str:
    """The difference of the accuracies, with its interval."""
    own, test = row.advantage, row.accuracy
    if test is None or own is None:
        return "-"
    interval = f" [{own.low:+.2f}, {own.high:+.2f}]" if own.ends else ""
    return effect(test).replace(" (", f"{interval} (")


def times_rows(table: Table) -> Iterator[Cells]:
    """Under TIMES: for each row with pairs a line per time."""
    for row in (own for own in table.rows if own.pairs):
        paper = table.published.get(row.name)
        for name, own in row.times.items():
            theirs = Rounded(paper.ratios[PLANNING]) if paper and name in READINGS else None
            value = Cell(own.ratio.mean, published=theirs, of_sums=own.ratio.of_sums).value
            both = (own.baseline, own.treatment)
            told = ("-" if mean is None else f"{1000 * mean:.1f} ms" for mean in both)
            ratios = (value.whole, value.of_sums or "-", value.marked)
            yield (row.name, in_words(name), *told, *ratios)


def optimum_rows(table: Table, robots: Compared) -> Iterator[Cells]:
    """Under OPTIMUM: for each row with pairs how far its robots are from the optimum."""
    for row in table.rows:
        if row.pairs and row.optimum:
            both = [row.optimum[robot] for robot in robots]
            told = ((str(own["trials"]), *(number(own[least]) for least in LEAST)) for own in both)
            yield (row.name, *chain.from_iterable(told))


def _notes(table: Table) -> Iterator[str]:
    """What is in no row, and whether the robots of the pairs met the same."""
    rows = [row for row in table.rows if row.name.isdigit()]
    apart = [f"{counted(count, 'pair')} of {name}" for name, count in table.apart.items()]
    for key, words in NOT_COUNTED.items():
        count = sum(row.left_out[key] for row in rows)
        apart += [f"{counted(count, 'pair')} {words}"] * (count > 0)
    undecided = sum(row.undecided for row in rows)
    if whole := [row.name for row in rows if row.whole]:
        yield population(whole)
    if undecided:
        yield f"In no accuracy: {counted(undecided, 'pair')} whose fewest actions are not known"
    if apart:
        yield f"In no row: {', '.join(apart)}"
    for meeting, words in MEETINGS.items():
        count = sum(row.meetings.get(meeting, 0) for row in rows)
        if count:
            yield f"{counted(count, 'pair')}: {words}"


def population(scenarios: Sequence[str]) -> str:
    """Why scenarios have no interval, and what a mark says of their values."""
    return (
        f"Scenario{'s' * (len(scenarios) > 1)} {listed(scenarios)}: every initial state was played "
        "and nothing was drawn; values are those of the whole population, without an interval, and "
        "a published one is marked by whether it is the same"
    )


def charts(own: Analysis) -> list[Chart]:
    """Accuracies and ratios with intervals by scenario, both tables and the published one."""
    beside = {
        way: {r.name: cells(table, r) for r in table.rows if r.pairs and r.name in PUBLISHED}
        for way, table in own.tables.items()
    }
    rows = [name for name in PUBLISHED if any(name in known for known in beside.values())]
    ratios = {name: f"{title}, TP / ATI" for name, title in zip(MEASURES, HEADINGS, strict=True)}
    robot = own.robots.treatment

    def series(name: str) -> list[Series]:
        """Ours in both ways of drawing, and the published values, by row."""
        drawn = {w: {r: c[name] for r, c in beside.get(w, {}).items()} for w in WAYS}
        ours = {w: points((r, c.ours) for r, c in own.items()) for w, own in drawn.items()}
        both = [(r, c.published) for own in drawn.values() for r, c in own.items()]
        return [
            Series(WAYS["triggered"], "first", ours["triggered"]),
            Series(WAYS["random"], "second", ours["random"], "s"),
            *published({row: own.value for row, own in both if own}.items()),
        ]

    return [
        *(Chart(f"{robot}-{n}", title, rows, series(n), "shares") for n, title in ROBOTS.items()),
        *(Chart(f"{robot}-{n}", title, rows, series(n)) for n, title in ratios.items()),
    ]
