"""Values beside published ones: whether these lie in our intervals, and both as text."""

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass

from testbed.analysis.bootstrap import Estimate
from testbed.analysis.statistics import Test
from testbed.text import chance
from testbed.text.grid import Grid

MEDIAN, OF_SUMS, PUBLISHED = "  median", "  of sums", "  published"
OUTSIDE, MARKED = " *", " (*: outside of our interval)"
"""How a published value is marked that does not lie in our interval, and what the mark says."""
HALF_DIGIT = 0.005
"""Published seconds and ratios have two decimals, shares whole percents."""

Cells = tuple[str, ...]


@dataclass(frozen=True)
class Rounded:
    """A published value, and by how much at most it may differ from what was rounded to it."""

    value: float
    half_digit: float = HALF_DIGIT


@dataclass(frozen=True)
class Value:
    """A cell as text: ours and the ends of its interval, its median, the ratio of sums.

    `inside` says whether the published value lies in our interval; None where one is missing.
    """

    ours: str
    ends: Cells = ()
    median: str = ""
    of_sums: str = ""
    published: str = ""
    inside: bool | None = None

    @property
    def whole(self) -> str:
        """Ours with its interval."""
        return f"{self.ours} [{', '.join(self.ends)}]" if self.ends else self.ours

    @property
    def marked(self) -> str:
        """The published value, marked where it does not lie in our interval."""
        return self.published + (OUTSIDE if self.inside is False else "")


@dataclass(frozen=True)
class Cell:
    """An estimate beside the published value; `share`: it is a share, else a ratio.

    `median` and `of_sums` stand beside a mean of ratios.
    """

    ours: Estimate | None
    median: Estimate | None = None
    published: Rounded | None = None
    of_sums: float | None = None
    share: bool = False

    @property
    def inside(self) -> bool | None:
        """Whether the published value lies in our interval; None where one of them is missing."""
        if self.ours is None or self.published is None:
            return None
        return self.ours.covers(self.published.value, self.published.half_digit)

    @property
    def value(self) -> Value:
        """The cell as text."""
        form = "{:.0%}" if self.share else "{:.2f}"
        return Value(
            *_text(self.ours, self.share),
            median="" if self.median is None else Value(*_text(self.median)).whole,
            of_sums="" if self.of_sums is None else f"{self.of_sums:.2f}",
            published="" if self.published is None else form.format(self.published.value),
            inside=self.inside,
        )


def _text(own: Estimate | None, share: bool = False) -> tuple[str, Cells]:
    """A ratio, or a share in percent, and the ends of its interval."""
    if own is None:
        return "-", ()
    if share:
        return f"{own.value:.1%}", tuple(f"{100 * end:.1f}" for end in own.ends)
    return f"{own.value:.2f}", tuple(f"{end:.2f}" for end in own.ends)


def effect(test: Test | None) -> str:
    """The effect of a test, with its p-value after Holm's correction."""
    return "-" if test is None or test.holm is None else f"{test.effect:+.2f} ({chance(test.holm)})"


@dataclass(frozen=True)
class Line:
    """A row: what it is about, the last of which is a number of pairs or trials, and its cells."""

    labels: Cells
    values: tuple[Value, ...]


@dataclass(frozen=True)
class Sheet:
    """A plain table of text; the first `names` columns are no numbers."""

    title: str
    columns: Cells
    rows: Sequence[Cells]
    names: int = 1


@dataclass(frozen=True)
class View:
    """A table of ours beside the published values; `name` is that of its place in a page."""

    name: str
    title: str
    columns: Cells
    lines: Sequence[Line]
    notes: Cells = ()
    sheets: Sequence[Sheet] = ()


def rows_of(lines: Iterable[Line]) -> Iterator[Cells]:
    """Each line as rows of text: ours with intervals, medians, ratios of sums, published values."""
    for line in lines:
        above = line.labels[:-2]
        yield (*line.labels, *(value.whole for value in line.values))
        for name, part in ((MEDIAN, "median"), (OF_SUMS, "of_sums")):
            if any(getattr(value, part) for value in line.values):
                yield (*above, name, "", *(getattr(value, part) for value in line.values))
        if any(value.published for value in line.values):
            yield (*above, PUBLISHED, "", *(value.marked or "-" for value in line.values))


def grid(view: View, title: str) -> Grid:
    """A view for a terminal: each interval below its value; medians are in the report alone."""
    lines = [
        [cells for row in rows_of([line]) if MEDIAN not in row for cells in _narrow(row)]
        for line in view.lines
    ]
    apart = any(len(own) > 1 for own in lines)
    cells: list[Cells | None] = []
    for before, own in zip((None, *lines), lines, strict=False):
        cells += [None] * (apart and before is not None and before[0][0] != own[0][0])
        cells += own
    marked = any(value.inside is False for line in view.lines for value in line.values)
    numbers = range(len(view.lines[0].labels) - 1, len(view.columns))
    return Grid(view.columns, cells, numbers, title + (MARKED if marked else ""))


def _narrow(row: Cells) -> Iterator[Cells]:
    parts = [cell.partition(" [") for cell in row]
    yield tuple(value for value, _, _ in parts)
    if any(bracket for _, bracket, _ in parts):
        yield tuple(bracket.strip() + rest for _, bracket, rest in parts)
