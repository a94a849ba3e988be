"""A place of several cells as a picture: a grid, and in each cell what is there."""

from __future__ import annotations

from collections.abc import Mapping
from math import ceil, sqrt

from testbed.environment.rendering.pen import BODY, FAINT, PAPER, WALL, Pen
from testbed.environment.rendering.scene import Place

_STRIP, _HEAD, _INDENT, _SMALL = 10, 13, 8, 8

Box = tuple[float, float, float, float]
"""Left, top, width, height."""


def draw_cells(pen: Pen, place: Place, box: Box, covers: Mapping[str, str]) -> None:
    """The cells row by row in their order, in as many columns as rows or one more.

    The order is that of the description: it does not say how cells lie to each other.
    """
    left, top, width, height = box
    columns = ceil(sqrt(len(place.cells)))
    rows = ceil(len(place.cells) / columns)
    wide, tall = width / columns, height / rows
    for number, cell in enumerate(place.cells):
        row, column = divmod(number, columns)
        _draw_cell(pen, place, cell, (left + column * wide, top + row * tall, wide, tall), covers)


def _draw_cell(pen: Pen, place: Place, cell: str, box: Box, covers: Mapping[str, str]) -> None:
    left, top, width, height = box
    pen.box(left, top, width, height, PAPER, edge=1, ink=WALL)
    label = cell.removeprefix(place.name).lstrip("_") or cell
    pen.text(left + 4, top + 7, label, _SMALL, FAINT, "lm")
    strips = _strips(place, cell, covers)
    fit = max(1, int((height - _HEAD) // (_STRIP + 1)))
    if len(strips) > fit:
        strips = [*strips[: fit - 1], (f"and {len(strips) - fit + 1} more", FAINT, 0)]
    for number, (name, colour, indent) in enumerate(strips):
        y = top + _HEAD + number * (_STRIP + 1)
        _draw_strip(pen, (left + 3 + indent, y, width - 6 - indent, _STRIP), name, colour)


def _strips(place: Place, cell: str, covers: Mapping[str, str]) -> list[tuple[str, str, int]]:
    """What is in a cell, with colours; what a robot holds stands under it, indented."""
    robots = {robot: held for robot, held in place.robots.items() if place.spots[robot] == cell}
    lying = [(thing, covers[thing], 0) for thing in place.things if place.spots[thing] == cell]
    held = {robot: [(t, covers[t], _INDENT) for t in things] for robot, things in robots.items()}
    return [*(s for robot in robots for s in ((robot, BODY, 0), *held[robot])), *lying]


def _draw_strip(pen: Pen, box: Box, name: str, colour: str) -> None:
    left, top, width, height = box
    pen.box(left, top, width, height, colour, radius=3, ink=colour)
    pen.text(left + width / 2, top + height / 2, name, _SMALL, PAPER)
