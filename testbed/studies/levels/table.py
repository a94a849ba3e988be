"""Tables 2 and 3 of a run as cells of text, beside the published figures."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass

from testbed.analysis.statistics import Estimate, Test
from testbed.studies.levels import comparing
from testbed.studies.levels.comparing import CONDITIONS, Cell, Levels, Line
from testbed.studies.levels.published import FIRST, PARTS, Paper
from testbed.studies.levels.results import Reasoning, Spread
from testbed.text.grid import Grid

HEADINGS = ("all", "fine", "coarse", "a refined plan")
"""What PARTS are called."""

SECONDS = ("level", "reasoning", "achieved", *HEADINGS)
SHARES = ("level", "reasoning", "trials", "achieved", "published")
RATIOS = ("level", "reasoning", "pairs", *HEADINGS)
GROWTH = ("level", "reasoning", "trials", *HEADINGS)
TESTS = ("level", "pairs", *HEADINGS, "achieved", "correct")
MEDIAN, OF_SUMS, PUBLISHED = "  median", "  of sums", "  published"
OUTSIDE, MARKED = " *", " (*: outside of our interval)"
"""How a published value is marked that does not lie in our interval, and what the mark says."""

Cells = tuple[str, ...]


@dataclass(frozen=True)
class LevelTable:
    """One of the tables: its title, the names of its columns, and its rows."""

    title: str
    columns: Cells
    rows: tuple[Cells, ...]


def level_tables(levels: Levels, paper: Paper) -> list[LevelTable]:
    """The tables of a run; those without rows are left out."""
    tables = [
        LevelTable("Reasoning in a trial", SECONDS, tuple(seconds_rows(levels, paper))),
        LevelTable("Trials that achieved their goal", SHARES, tuple(share_rows(levels, paper))),
        LevelTable(_ratio_title(levels, paper), RATIOS, tuple(ratio_rows(levels, paper))),
        LevelTable(f"Times that at {FIRST}", GROWTH, tuple(growth_rows(levels, paper))),
    ]
    return [table for table in tables if table.rows]


def _ratio_title(levels: Levels, paper: Paper) -> str:
    few = comparing.has_few(comparing.ratios(levels, paper))
    return "No zoom / zoom, over pairs" + (f"; {comparing.FEW_PAIRS}" if few else "")


def seconds_rows(levels: Levels, paper: Paper) -> Iterator[Cells]:
    """For each level and condition means with deviations, medians, and what was published."""
    for name, level in levels.items():
        for robot, own in level.reasoning.items():
            spreads: list[Spread | None] = [getattr(own, part) for part in PARTS]
            ours = ("-" if s is None else spread(s.mean, s.sd) for s in spreads)
            yield (name, CONDITIONS.get(robot, robot), achieved(own), *ours)
            yield (name, MEDIAN, "", *("-" if s is None else seconds(s.median) for s in spreads))
            theirs = [paper.seconds(name, robot, part) for part in PARTS]
            if any(theirs):
                yield (name, PUBLISHED, "", *("-" if t is None else spread(*t) for t in theirs))


def achieved(own: Reasoning) -> str:
    """How many, and of the others how many had a goal out of reach."""
    return f"{own.achieved}/{own.trials}{out_of_reach(own)}"


def out_of_reach(own: Reasoning) -> str:
    """How many trials ended with their goal out of reach, after their number, where there are."""
    return f", {own.out_of_reach} out of reach" if own.out_of_reach else ""


def share_rows(levels: Levels, paper: Paper) -> Iterator[Cells]:
    """For each level and condition the share with its interval, and the published one."""
    for line in comparing.shares(levels, paper):
        cells = [text for cell in line.cells for text in (share(cell.ours), _share(cell))]
        yield (line.level, line.what, str(line.number), *cells)


def ratio_rows(levels: Levels, paper: Paper) -> Iterator[Cells]:
    """For each level means with intervals, medians, and the published means."""
    return _of_lines(comparing.ratios(levels, paper))


def growth_rows(levels: Levels, paper: Paper) -> Iterator[Cells]:
    """For each level and condition that of the means, of the medians, and the published ones."""
    return _of_lines(comparing.growth(levels, paper))


def _of_lines(lines: Iterable[Line]) -> Iterator[Cells]:
    for line in lines:
        means = (times(cell.ours) for cell in line.cells)
        yield (line.level, line.what, str(line.number), *means)
        yield (line.level, MEDIAN, "", *(times(cell.median) for cell in line.cells))
        if any(cell.of_sums is not None for cell in line.cells):
            yield (line.level, OF_SUMS, "", *(_number(cell.of_sums) for cell in line.cells))
        if any(cell.published is not None for cell in line.cells):
            yield (line.level, PUBLISHED, "", *map(_times, line.cells))


def effect_rows(levels: Levels) -> Iterator[Cells]:
    """For each level the effect sizes, with the p-values after Holm's correction."""
    for name, level in levels.items():
        own = level.compared
        if own.pairs:
            tests = [*(own.ratios[part].test for part in PARTS), own.completed_test]
            yield (name, str(own.pairs), *map(_effect, [*tests, own.correct_test]))


def _effect(test: Test | None) -> str:
    if test is None or test.holm is None:
        return "-"
    chance = "p < 0.001" if test.holm < 0.001 else f"p = {test.holm:.3f}"
    return f"{test.effect:+.2f} ({chance})"


def seconds(value: float) -> str:
    """Seconds as text: in ms where they are few."""
    return f"{1000 * value:.1f} ms" if value < 1.0 else f"{value:.2f} s"


def spread(mean: float, deviation: float) -> str:
    """Mean and deviation in seconds, both in ms where the mean is short."""
    if mean < 1.0:
        return f"{1000 * mean:.1f} ± {1000 * deviation:.1f} ms"
    return f"{mean:.2f} ± {deviation:.2f} s"


def share(estimate: Estimate | None) -> str:
    """A share with its interval, in percent."""
    if estimate is None:
        return "-"
    value, low, high = (100 * end for end in (estimate.value, estimate.low, estimate.high))
    return f"{value:.1f}%" if estimate.single else f"{value:.1f}% [{low:.1f}, {high:.1f}]"


def times(estimate: Estimate | None) -> str:
    """A ratio with its interval."""
    if estimate is None:
        return "-"
    interval = "" if estimate.single else f" [{estimate.low:.2f}, {estimate.high:.2f}]"
    return f"{estimate.value:.2f}{interval}"


def _number(value: float | None) -> str:
    return "-" if value is None else f"{value:.2f}"


def _share(cell: Cell) -> str:
    return "-" if cell.published is None else f"{cell.published.value:.0%}{_mark(cell)}"


def _times(cell: Cell) -> str:
    return "-" if cell.published is None else f"{cell.published.value:.2f}{_mark(cell)}"


def _mark(cell: Cell) -> str:
    return OUTSIDE if cell.inside is False else ""


def level_grid(shown: LevelTable) -> Grid:
    """A table for a terminal, with an empty line between levels; medians are in the report."""
    rows = [row for row in shown.rows if row[1] != MEDIAN]
    cells: list[Sequence[str] | None] = []
    for before, row in zip((None, *rows), rows, strict=False):
        if before is not None and before[0] != row[0]:
            cells.append(None)
        cells.extend(_narrow(row))
    title = shown.title + (MARKED if _marked(shown) else "")
    return Grid(shown.columns, cells, range(3, len(shown.columns)), title)


def _marked(shown: LevelTable) -> bool:
    return any(cell.endswith(OUTSIDE) for row in shown.rows for cell in row)


def _narrow(row: Sequence[str]) -> Iterator[Cells]:
    """The same for few columns of text: each interval below its value."""
    parts = [cell.partition(" [") for cell in row]
    yield tuple(value for value, _, _ in parts)
    if any(bracket for _, bracket, _ in parts):
        yield tuple(bracket.strip() + rest for _, bracket, rest in parts)
