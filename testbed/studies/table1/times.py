"""The times of Table 1: planning, diagnosis and both, of which the published column has one."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from math import exp, log
from statistics import fmean

from testbed.analysis.statistics import Estimate
from testbed.experiment.wording import in_words
from testbed.studies.table1.pairing import Pair, Side
from testbed.studies.table1.published import HALF_CENT, PLANNING, PUBLISHED, SCENARIOS, Published
from testbed.studies.table1.results import Analysis, Ratio, Row, Seconds, Table
from testbed.text.markdown import markdown, paragraph

COLUMNS = ("scenario", "time", "TP", "ATI", "mean of ratios", "ratio of sums", "published")
READINGS = ("planning_time", "reasoning_time")
"""What the published planning time can mean: planning alone, or all reasoning."""

INTRODUCTION = """\
## Planning, diagnosis and both

Process time of the robots, their solvers included, and without what is prepared once and reused;
means per trial. *Reasoning time* is planning and diagnosis together. The mean of ratios weighs
pairs alike, the ratio of sums (of TP's times over ATI's) weighs seconds alike: a few long trials
decide it. The published column is called planning time; its value stands beside both readings.
"""


def seconds(
    pairs: Sequence[Pair], ratios: Mapping[str, Ratio], weights: Mapping[str, float]
) -> dict[str, Seconds]:
    """The times of pairs that count by the names of measures; `ratios` are of these measures.

    `weights`: what a pair weighs, by the scenario that was played.
    """
    return {
        name: Seconds(
            baseline=_mean(pairs, [pair.base for pair in pairs], name, weights),
            intentional=_mean(pairs, [pair.mind for pair in pairs], name, weights),
            ratio=ratio,
        )
        for name, ratio in ratios.items()
    }


def _mean(
    pairs: Sequence[Pair], sides: Sequence[Side], name: str, weights: Mapping[str, float]
) -> float | None:
    if not pairs:
        return None
    return fmean(
        (side.measures[name] for side in sides), weights=[weights[pair.intended] for pair in pairs]
    )


def section(analysis: Analysis) -> str:
    """The section of a page: a table for each way of drawing, and what the published column is."""
    both = (("triggered", analysis.triggered), ("random", analysis.random))
    rows = [
        (f"{way}, {cells[0]}", *cells[1:])
        for way, table in both
        if table is not None
        for cells in rows_of(table)
    ]
    return f"{INTRODUCTION}\n{markdown(COLUMNS, rows)}\n\n{_reading(analysis)}\n"


def rows_of(table: Table) -> Iterator[tuple[str, ...]]:
    """Under COLUMNS: for each row with pairs a line per time."""
    for row in table.rows:
        if row.pairs:
            paper = table.published.get(row.name)
            yield from (_line(row, name, own, paper) for name, own in row.times.items())


def _line(row: Row, name: str, own: Seconds, paper: Published | None) -> tuple[str, ...]:
    mean = own.ratio.mean
    return (
        row.name,
        in_words(name),
        _milliseconds(own.baseline),
        _milliseconds(own.intentional),
        "-" if mean is None else _with_interval(mean),
        "-" if own.ratio.of_sums is None else f"{own.ratio.of_sums:.2f}",
        _published(paper, mean) if paper is not None and name in READINGS else "",
    )


def _with_interval(mean: Estimate) -> str:
    interval = "" if mean.single else f" [{mean.low:.2f}, {mean.high:.2f}]"
    return f"{mean.value:.2f}{interval}"


def _published(paper: Published, ours: Estimate | None) -> str:
    value = paper.ratios[PLANNING]
    outside = ours is not None and ours.covers(value, HALF_CENT) is False
    return f"{value:.2f}{' *' if outside else ''}"


def _milliseconds(value: float | None) -> str:
    return "-" if value is None else f"{1000 * value:.1f} ms"


def _reading(analysis: Analysis) -> str:
    """What the published column can mean, and how far each reading is from it."""
    tables = [table for table in (analysis.triggered, analysis.random) if table is not None]
    rows = [row for table in tables for row in table.rows if row.name in SCENARIOS]
    far = {name: _distance(rows, name) for name in READINGS}
    said = "; ".join(
        f"{in_words(name)} by a factor of {factor:.2f}"
        for name, factor in far.items()
        if factor is not None
    )
    return paragraph(
        "Published total time is planning time plus execution time. Diagnosis, if it was measured, "
        "is therefore part of the published planning time, which then is our reasoning time; if it "
        "was left out of the total, too, the column is our planning time. It cannot be diagnosis "
        "alone: in scenario 1 there is nothing to explain. Our means of ratios differ from it, on "
        f"the geometric average over scenarios 1 to 5: {said or 'there are none'}. Which robot "
        f"needs less depends on the reading in {_reversed(analysis) or 'none of the rows'}."
    )


def _reversed(analysis: Analysis) -> str:
    """The rows in which one mean of ratios is below 1 and the other above it."""
    both = (("triggered", analysis.triggered), ("random", analysis.random))
    return "; ".join(
        f"{way}, {row.name}"
        for way, table in both
        if table is not None
        for row in table.rows
        if row.pairs and _disagree(*(row.times[name].ratio.mean for name in READINGS))
    )


def _disagree(one: Estimate | None, other: Estimate | None) -> bool:
    return one is not None and other is not None and (one.value - 1) * (other.value - 1) < 0


def _distance(rows: Sequence[Row], name: str) -> float | None:
    """The geometric mean of how many times ours is the published value, or the reverse."""
    means = [(row.name, row.times[name].ratio.mean) for row in rows if row.pairs]
    logs = [
        abs(log(mean.value / PUBLISHED[row].ratios[PLANNING]))
        for row, mean in means
        if mean is not None and mean.value
    ]
    return exp(fmean(logs)) if logs else None
