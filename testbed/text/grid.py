"""Tables for a terminal of any width: text wraps or moves below its row, numbers are never cut."""

import textwrap
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from itertools import zip_longest

from rich.cells import cell_len

from testbed.text import plain

GAP, INDENT = 2, 4
LEAST_TEXT = 24
"""Columns below which the last column, where it is text, stands below its row."""
Cells = Sequence[str]


@dataclass(frozen=True)
class Grid:
    """Cells under headings; None is an empty line. Columns of `numbers` are never narrowed."""

    columns: Cells
    rows: Sequence[Cells | None]
    numbers: range
    title: str = ""

    def lines(self, width: int) -> Iterator[str]:
        """The table in lines of at most `width` columns, as far as words and numbers allow it."""
        if self.title:
            yield from textwrap.wrap(plain(self.title), width)
        rows = [row and list(map(plain, row)) for row in self.rows]
        yield from replace(self, columns=list(map(plain, self.columns)), rows=rows)._lines(width)

    def _lines(self, width: int) -> Iterator[str]:
        whole = self._widths(width)
        if whole is not None:
            for row in (self.columns, *self.rows):
                yield from self._row(row, whole)
            return
        first = replace(self, columns=self.columns[:-1], rows=[r and r[:-1] for r in self.rows])
        narrow = None if len(first.columns) in self.numbers else first._widths(width)
        if narrow is None:
            yield from self._stacked(width)
            return
        yield from first._row(first.columns, narrow)
        for row in self.rows:
            yield from first._row(row and row[:-1], narrow)
            if row and row[-1]:
                yield from _broken(" " * INDENT + f"{self.columns[-1]} {row[-1]}", width)

    def _widths(self, width: int) -> list[int] | None:
        """The widths of the columns, those of text narrowed as needed; None if that is too wide."""
        whole = [self.columns, *(row for row in self.rows if row)]
        widths = [max(map(cell_len, column)) for column in zip(*whole, strict=True)]
        least = [self._least(number, own) for number, own in enumerate(widths)]
        while sum(widths) > width - GAP * (len(widths) - 1):
            wide = [number for number, own in enumerate(widths) if own > least[number]]
            if not wide:
                return None
            widths[max(wide, key=widths.__getitem__)] -= 1
        return widths

    def _least(self, number: int, width: int) -> int:
        """How narrow a column may be: headings and text wrap at blanks, numbers do not."""
        cells = [row[number] for row in self.rows if row]
        if number not in self.numbers:
            cells = [word for cell in cells for word in cell.split()]
        longest = max(map(cell_len, [*cells, *self.columns[number].split()]))
        last = number == len(self.columns) - 1 and number not in self.numbers
        return max(longest, min(width, LEAST_TEXT)) if last else longest

    def _row(self, row: Cells | None, widths: Sequence[int]) -> Iterator[str]:
        if row is None:
            yield ""
            return
        wrapped = [_wrapped(cell, width) for cell, width in zip(row, widths, strict=True)]
        for parts in zip_longest(*wrapped, fillvalue=""):
            cells = (self._aligned(i, part, widths[i]) for i, part in enumerate(parts))
            yield (" " * GAP).join(cells).rstrip()

    def _aligned(self, number: int, cell: str, width: int) -> str:
        blanks = " " * (width - cell_len(cell))
        return blanks + cell if number in self.numbers else cell + blanks

    def _stacked(self, width: int) -> Iterator[str]:
        """Each row as pairs of a heading and its cell, as many to a line as fit."""
        for row in self.rows:
            if row is None:
                yield ""
                continue
            pairs = zip(self.columns, row, strict=True)
            line, *told = [f"{name} {cell.strip()}" for name, cell in pairs if cell.strip()]
            for pair in told:
                if cell_len(line) + GAP + cell_len(pair) > width:
                    yield from _broken(line, width)
                    line = " " * INDENT + pair
                else:
                    line += " " * GAP + pair
            yield from _broken(line, width)


def _broken(line: str, width: int) -> list[str]:
    """A line in several, those after the first further in."""
    indents = " " * (len(line) - len(line.lstrip())), " " * (INDENT + GAP)
    wrapper = textwrap.TextWrapper(width, *indents, break_on_hyphens=False)
    return wrapper.wrap(line.strip())


def _wrapped(cell: str, width: int) -> list[str]:
    if cell_len(cell) <= width:
        return [cell]
    return textwrap.wrap(cell, width, break_on_hyphens=False) or [""]
