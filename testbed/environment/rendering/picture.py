"""A scene as a picture: rooms in rows with doors between them, books, robots, and locks.

Of a place of several cells a grid, and in each cell what is there. None of it needs a screen.
"""

from __future__ import annotations

from collections.abc import Mapping
from itertools import pairwise
from math import ceil, sqrt
from typing import Any, TypeAlias

import numpy as np
from numpy.typing import NDArray
from PIL import Image as Pillow
from PIL import ImageDraw, ImageFont

from testbed.environment.rendering.scene import Place, Scene

Image: TypeAlias = NDArray[np.uint8]
"""Height x width x 3."""

PAPER, FLOOR, WALL, INK, FAINT = "#ffffff", "#f6f1e7", "#4a4a4a", "#222222", "#777777"
SHUT, OPEN, BODY, FACE = "#c0392b", "#2e8b57", "#3d6ea5", "#dbe9f6"

_ROOM, _TALL, _EDGE, _FOOT, _PER_ROW = 230, 250, 20, 74, 4
_STRIP, _HEAD, _INDENT, _SMALL = 10, 13, 8, 8

Box = tuple[float, float, float, float]
"""Left, top, width, height."""

_COVERS = ("#b5532a", "#6a8f3c", "#7b5ea7", "#c29a2b", "#3a8f8f", "#a8486f")
_FINER = 2  # drawn so many times larger and scaled down, for smooth edges


def draw_picture(scene: Scene) -> Image:
    """The picture as an array of shape (height, width, 3)."""
    columns = max(1, min(_PER_ROW, len(scene.places)))
    rows = -(-len(scene.places) // _PER_ROW)
    pen = Pen(columns * _ROOM + 2 * _EDGE, rows * _TALL + 2 * _EDGE + _FOOT)
    covers = _covers(scene)
    for number, place in enumerate(scene.places):
        _draw_place(pen, place, *_corner(number), covers)
    for number, (left, right) in enumerate(pairwise(scene.places)):
        if right.name in left.next_to and (number + 1) % _PER_ROW:
            _draw_door(pen, *_corner(number + 1), shut=_locked(left) or _locked(right))
    _draw_caption(pen, scene, rows * _TALL + 2 * _EDGE)
    return pen.pixels()


def _corner(number: int) -> tuple[int, int]:
    row, column = divmod(number, _PER_ROW)
    return _EDGE + column * _ROOM, _EDGE + row * _TALL


def _locked(place: Place) -> bool:
    return any(place.marks.values())


def _covers(scene: Scene) -> dict[str, str]:
    """A colour for each thing, the same in every picture of a domain."""
    held = [t for p in scene.places for things in p.robots.values() for t in things]
    things = sorted({*held, *(t for p in scene.places for t in p.things)})
    return {thing: _COVERS[i % len(_COVERS)] for i, thing in enumerate(things)}


def _draw_place(pen: Pen, place: Place, x: int, y: int, covers: dict[str, str]) -> None:
    pen.box(x, y, _ROOM, _TALL, FLOOR, edge=3, ink=WALL)
    pen.text(x + _ROOM / 2, y + 22, place.name, 18, INK)
    for name, true in place.marks.items():
        _draw_lock(pen, x + _ROOM / 2, y + 52, name if true else f"not {name}", true)
    if place.cells:
        head = 64 if place.marks else 40
        _draw_cells(pen, place, (x + 14, y + head, _ROOM - 28, _TALL - head - 12), covers)
        return
    for number, (robot, held) in enumerate(place.robots.items()):
        _draw_robot(pen, x + 62 + 80 * number, y + 118, robot, held, covers)
    for number, thing in enumerate(place.things):
        row, column = divmod(number, 3)
        from_left = 2 - column if row else column  # a second layer grows away from the robots
        _draw_book(pen, x + 18 + 68 * from_left, y + 202 - 44 * row, thing, covers)


def _draw_door(pen: Pen, x: int, y: int, shut: bool) -> None:
    """A door in the wall on the left of a place: a gap, barred if one of its sides is locked."""
    pen.box(x - 4, y + 92, 8, 72, SHUT if shut else FLOOR, ink=SHUT if shut else FLOOR)
    for edge in (92, 164):
        pen.line(x - 10, y + edge, x + 10, y + edge, WALL, 3)


def _draw_lock(pen: Pen, x: float, y: float, words: str, shut: bool) -> None:
    colour = SHUT if shut else OPEN
    lift, aside = (0, 0) if shut else (3, 8)
    pen.arc(x - 44 + aside, y - 5 - lift, 6, colour, 3)
    pen.box(x - 53, y - 4, 18, 14, colour, radius=2, ink=colour)
    pen.text(x - 24, y + 3, words, 14, colour, "lm")


def _draw_robot(
    pen: Pen, x: float, y: float, name: str, held: tuple[str, ...], covers: dict[str, str]
) -> None:
    pen.line(x, y - 34, x, y - 24, BODY, 3)
    pen.dot(x, y - 36, 4, SHUT)
    pen.box(x - 20, y - 26, 40, 28, FACE, radius=8, edge=3, ink=BODY)
    pen.dot(x - 8, y - 12, 4, INK)
    pen.dot(x + 8, y - 12, 4, INK)
    pen.box(x - 26, y + 6, 52, 44, BODY, radius=8, ink=BODY)
    pen.text(x, y + 28, name, 14, PAPER)
    pen.dot(x - 14, y + 56, 7, WALL)
    pen.dot(x + 14, y + 56, 7, WALL)
    pen.line(x + 24, y + 18, x + 52, y + 6, BODY, 6)
    pen.dot(x + 53, y + 5, 6, BODY)
    for number, thing in enumerate(held):
        _draw_book(pen, x + 46, y - 32 - 40 * number, thing, covers)


def _draw_book(pen: Pen, x: float, y: float, name: str, covers: dict[str, str]) -> None:
    pen.box(x, y, 60, 34, covers[name], radius=3, ink=covers[name])
    pen.box(x + 5, y + 28, 52, 4, PAPER, ink=PAPER)
    pen.line(x + 6, y, x + 6, y + 28, PAPER, 1)
    pen.text(x + 33, y + 14, name, 13, PAPER)


def _draw_caption(pen: Pen, scene: Scene, y: float) -> None:
    pen.text(_EDGE, y + 8, f"step {scene.step}", 18, INK, "lm")
    pen.text(_EDGE + 110, y + 8, scene.outcome.replace("_", " "), 18, SHUT, "lm")
    before = f"robot: {scene.robot or '-'}     adversary: {scene.adversary or '-'}"
    pen.text(_EDGE, y + 36, f"just now    {before}", 15, FAINT, "lm")
    if scene.rest:
        pen.text(_EDGE, y + 58, f"also true: {', '.join(scene.rest)}", 15, FAINT, "lm")


def _draw_cells(pen: Pen, place: Place, box: Box, covers: Mapping[str, str]) -> None:
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


class Pen:
    """Draws in the picture's own pixels on the finer canvas."""

    def __init__(self, width: int, height: int) -> None:
        self._size = (width, height)
        self._image = Pillow.new("RGB", (width * _FINER, height * _FINER), PAPER)
        self._draw = ImageDraw.Draw(self._image)

    def box(self, x: float, y: float, wide: float, tall: float, fill: str, **more: Any) -> None:
        corners = [v * _FINER for v in (x, y, x + wide, y + tall)]
        radius, edge = more.get("radius", 0) * _FINER, more.get("edge", 0) * _FINER
        self._draw.rounded_rectangle(corners, radius, fill, more.get("ink", INK), edge)

    def dot(self, x: float, y: float, radius: float, fill: str) -> None:
        box = [v * _FINER for v in (x - radius, y - radius, x + radius, y + radius)]
        self._draw.ellipse(box, fill)

    def line(self, x: float, y: float, x2: float, y2: float, ink: str, wide: int) -> None:
        self._draw.line([v * _FINER for v in (x, y, x2, y2)], ink, wide * _FINER)

    def arc(self, x: float, y: float, radius: float, ink: str, wide: int) -> None:
        box = [v * _FINER for v in (x - radius, y - radius, x + radius, y + radius)]
        self._draw.arc(box, 180, 360, ink, wide * _FINER)

    def text(self, x: float, y: float, words: str, size: int, ink: str, anchor: str = "mm") -> None:
        font = ImageFont.load_default(size * _FINER)
        self._draw.text((x * _FINER, y * _FINER), words, ink, font, anchor)

    def pixels(self) -> Image:
        small = self._image.resize(self._size, Pillow.Resampling.LANCZOS)
        return np.asarray(small, dtype=np.uint8)
