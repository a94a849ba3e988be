"""Tables 2 and 3 of a run beside the published figures."""

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path

from testbed.studies.charts import Chart, Colour, Key, Point, Series, points, published
from testbed.studies.levels.measures import Level, Levels, Reasoning, Spread
from testbed.studies.levels.published import FIRST, NO_ZOOM, PARTS, ZOOM
from testbed.studies.study import Section
from testbed.studies.tables import Cell, Cells, Line, Sheet, Value, View, effect

CONDITIONS = {ZOOM: "zoom", NO_ZOOM: "no zoom"}
RATIO = "no zoom / zoom"
HEADINGS = ("all", "fine", "coarse", "a refined plan")
"""Names of PARTS."""
REASONING = ("level", "reasoning", "trials", "achieved", *HEADINGS)
RATIOS = ("level", "reasoning", "pairs", *HEADINGS)
GROWTH = ("level", "reasoning", "trials", *HEADINGS)
TESTS = ("level", "pairs", *HEADINGS, "achieved", "correct")
TITLES = (
    "all reasoning of a trial",
    "at the fine resolution",
    "at the coarse resolution",
    "one refined plan",
)
LEGEND = (
    Key("line", "first", "zoom"),
    Key("line square", "second", "no zoom"),
    Key("dashed", "paper", "published"),
    Key("square", "second", "no zoom / zoom, with its 95% interval"),
    Key("published", "paper", "published"),
)
LOOKS: Mapping[str, tuple[Colour, str]] = {ZOOM: ("first", "o"), NO_ZOOM: ("second", "s")}
LEAST = 0.1
FEW = 20
"""Pairs of a level below which the start of a process is much of its times."""
FEW_PAIRS = "few pairs: the first trials also prepare what later ones use"


@dataclass(frozen=True)
class Row:
    """A level, the condition whose figures these are ("" where both are compared), their number."""

    level: str
    robot: str
    number: int
    cells: tuple[Cell, ...]

    @property
    def what(self) -> str:
        """What the row is about."""
        return CONDITIONS.get(self.robot, self.robot) or RATIO

    @property
    def line(self) -> Line:
        """The row as text."""
        labels = (self.level, self.what, str(self.number))
        return Line(labels, tuple(cell.value for cell in self.cells))


def shares(found: Levels) -> Iterator[Row]:
    """The shares of the trials that achieved their goal, one row per level and condition."""
    for name, level in found.levels.items():
        for robot, own in level.compared.completed.items():
            cell = Cell(own, published=found.paper.completed(name, robot), share=True)
            yield Row(name, robot, level.reasoning[robot].trials, (cell,))


def ratios(found: Levels) -> Iterator[Row]:
    """No zoom / zoom by part of the time, one row per level that has pairs."""
    for name, level in found.levels.items():
        own = level.compared.ratios
        if pairs := max(ratio.pairs for ratio in own.values()):
            cells = (
                Cell(ratio.mean, ratio.median, found.paper.ratio(name, part), ratio.of_sums)
                for part, ratio in own.items()
            )
            yield Row(name, "", pairs, tuple(cells))


def growth(found: Levels) -> Iterator[Row]:
    """How many times a time is that at the first level, one row per level and condition."""
    for name, level in found.levels.items():
        for robot, own in level.compared.growth.items():
            cells = (
                Cell(grown.mean, grown.median, found.paper.growth(name, robot, part))
                for part, grown in own.items()
            )
            yield Row(name, robot, level.reasoning[robot].trials, tuple(cells))


def sections(found: Levels) -> list[Section]:
    """The section of the levels."""
    few = any(row.number < FEW for row in ratios(found))
    views = [
        View(
            "levels-seconds",
            "Trials that achieved their goal, and seconds",
            REASONING,
            list(_reasoning(found)),
            (
                "Shares with their intervals, exact ones where all trials ended alike; means and "
                "standard deviations of times",
            ),
        ),
        View(
            "levels-ratios",
            "No zoom / zoom" + f"; {FEW_PAIRS}" * few,
            RATIOS,
            [row.line for row in ratios(found)],
            ("Means over the pairs in which both achieved the goal; above 1 zooming saved time",),
        ),
        View(
            "levels-growth",
            f"Growth from {FIRST}",
            GROWTH,
            [row.line for row in growth(found)],
            (f"How many times the mean at {FIRST} in the same condition the mean at a level is",),
        ),
    ]
    tests = Sheet("Effect sizes and tests", TESTS, list(effect_rows(found.levels)))
    paper = bool(found.paper.conditions)
    return [
        Section(
            name="levels",
            title="Reasoning at each level",
            views=[view for view in views if view.lines],
            charts=[*time_charts(found), *ratio_charts(found)],
            legend=[key for key in LEGEND if paper or key.text != "published"],
            sheets=[tests] if tests.rows else [],
            template=Path(__file__).with_name("section.html.j2"),
            values={"paper": paper},
        )
    ]


def _reasoning(found: Levels) -> Iterator[Line]:
    for row in shares(found):
        own = found.levels[row.level].reasoning[row.robot]
        times = (
            timed(getattr(own, part), found.paper.seconds(row.level, row.robot, part))
            for part in PARTS
        )
        labels = (row.level, row.what, f"{own.trials}{out_of_reach(own)}")
        yield Line(labels, (*row.line.values, *times))


def out_of_reach(own: Reasoning) -> str:
    """How many trials ended with their goal out of reach, after their number, where there are."""
    return f", {own.out_of_reach} out of reach" if own.out_of_reach else ""


def timed(own: Spread | None, theirs: tuple[float, float] | None) -> Value:
    """Mean and deviation of a time, and its median."""
    published = "" if theirs is None else spread(*theirs)
    if own is None:
        return Value("-", published=published)
    return Value(spread(own.mean, own.sd), median=seconds(own.median), published=published)


def seconds(value: float) -> str:
    """Seconds as text: in ms where they are few."""
    return f"{1000 * value:.1f} ms" if value < 1.0 else f"{value:.2f} s"


def spread(mean: float, deviation: float) -> str:
    """Mean and deviation in seconds, both in ms where the mean is short."""
    if mean < 1.0:
        return f"{1000 * mean:.1f} ± {1000 * deviation:.1f} ms"
    return f"{mean:.2f} ± {deviation:.2f} s"


def effect_rows(levels: Mapping[str, Level]) -> Iterator[Cells]:
    """For each level the effect sizes, with the p-values after Holm's correction."""
    for name, level in levels.items():
        own = level.compared
        if own.pairs:
            tests = [*(own.ratios[part].test for part in PARTS), own.completed_test]
            yield (name, str(own.pairs), *map(effect, [*tests, own.correct_test]))


def time_charts(found: Levels) -> list[Chart]:
    """A figure for each part of the time."""
    return [
        Chart(f"levels-{part}", title, list(found.levels), list(_times(found, part)), "seconds")
        for part, title in zip(PARTS, TITLES, strict=True)
    ]


def _times(found: Levels, part: str) -> Iterator[Series]:
    for robot, (colour, marker) in LOOKS.items():
        theirs = ((name, found.paper.seconds(name, robot, part)) for name in found.levels)
        for label, times, paper in (
            (CONDITIONS[robot], _ours(found, robot, part), False),
            (f"{CONDITIONS[robot]}, published", theirs, True),
        ):
            drawn = tuple(_point(level, *time) for level, time in times if time is not None)
            if drawn:
                yield Series(label, colour, drawn, marker, paper)


def _ours(found: Levels, robot: str, part: str) -> Iterator[tuple[str, tuple[float, float] | None]]:
    for name, level in found.levels.items():
        own = level.reasoning.get(robot)
        time: Spread | None = None if own is None else getattr(own, part)
        yield name, (time.mean, time.sd) if time is not None and time.mean > 0 else None


def _point(level: str, mean: float, deviation: float) -> Point:
    """A deviation beyond zero ends at a tenth of the mean: the scale is logarithmic."""
    return Point(level, mean, max(mean - deviation, LEAST * mean), mean + deviation)


def ratio_charts(found: Levels) -> Iterator[Chart]:
    """A figure for each of the ratios that zooming is about; none where no pair was played."""
    rows = list(ratios(found))
    levels = [row.level for row in rows]
    columns = zip(*(row.cells for row in rows), strict=True)
    for part, title, cells in zip(PARTS, TITLES, columns, strict=False):
        if part in ("total", "refined_plan"):
            beside = list(zip(levels, cells, strict=True))
            ours = points((level, cell.ours) for level, cell in beside)
            theirs = ((level, own.published.value) for level, own in beside if own.published)
            series = [Series(RATIO, "second", ours, "s"), *published(theirs)]
            yield Chart(f"levels-ratio-{part}", f"{RATIO}, {title}", levels, series)
