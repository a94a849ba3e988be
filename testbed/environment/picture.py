"""A scene as a picture: rooms in rows with doors between them, books, robots, and locks."""

from __future__ import annotations

from itertools import pairwise
from typing import Any, TypeAlias

import numpy as np
from numpy.typing import NDArray
from PIL import Image as Pillow
from PIL import ImageDraw, ImageFont

from testbed.environment.scene import Place, Scene

Image: TypeAlias = NDArray[np.uint8]
"""Height x width x 3."""

_FINER = 2  # drawn so many times larger and scaled down, for smooth edges
_ROOM, _TALL, _EDGE, _FOOT, _PER_ROW = 230, 250, 20, 74, 4

_PAPER, _FLOOR, _WALL, _INK, _FAINT = "#ffffff", "#f6f1e7", "#4a4a4a", "#222222", "#777777"
_SHUT, _OPEN, _BODY, _FACE = "#c0392b", "#2e8b57", "#3d6ea5", "#dbe9f6"
_COVERS = ("#b5532a", "#6a8f3c", "#7b5ea7", "#c29a2b", "#3a8f8f", "#a8486f")


def draw_picture(scene: Scene) -> Image:
    """The picture as an array of shape (height, width, 3)."""
    columns = max(1, min(_PER_ROW, len(scene.places)))
    rows = -(-len(scene.places) // _PER_ROW)
    pen = _Pen(columns * _ROOM + 2 * _EDGE, rows * _TALL + 2 * _EDGE + _FOOT)
    covers = _covers(scene)
    for number, place in enumerate(scene.places):
        _draw_place(pen, place, *_corner(number), covers)
    for number, (left, right) in enumerate(pairwise(scene.places)):
        if right.name in left.next_to and (number + 1) % _PER_ROW:
            _draw_door(pen, *_corner(number + 1), shut=_locked(left) or _locked(right))
    _draw_caption(pen, scene, rows * _TALL + 2 * _EDGE)
    return pen.pixels()


class _Pen:
    """Draws in the picture's own pixels on the finer canvas."""

    def __init__(self, width: int, height: int) -> None:
        self._size = (width, height)
        self._image = Pillow.new("RGB", (width * _FINER, height * _FINER), _PAPER)
        self._draw = ImageDraw.Draw(self._image)

    def box(self, x: float, y: float, wide: float, tall: float, fill: str, **more: Any) -> None:
        corners = [v * _FINER for v in (x, y, x + wide, y + tall)]
        radius, edge = more.get("radius", 0) * _FINER, more.get("edge", 0) * _FINER
        self._draw.rounded_rectangle(corners, radius, fill, more.get("ink", _INK), edge)

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


def _draw_place(pen: _Pen, place: Place, x: int, y: int, covers: dict[str, str]) -> None:
    pen.box(x, y, _ROOM, _TALL, _FLOOR, edge=3, ink=_WALL)
    pen.text(x + _ROOM / 2, y + 22, place.name, 18, _INK)
    for name, true in place.marks.items():
        _draw_lock(pen, x + _ROOM / 2, y + 52, name if true else f"not {name}", true)
    for number, (robot, held) in enumerate(place.robots.items()):
        _draw_robot(pen, x + 62 + 80 * number, y + 118, robot, held, covers)
    for number, thing in enumerate(place.things):
        row, column = divmod(number, 3)
        from_left = 2 - column if row else column  # a second layer grows away from the robots
        _draw_book(pen, x + 18 + 68 * from_left, y + 202 - 44 * row, thing, covers)


def _draw_door(pen: _Pen, x: int, y: int, shut: bool) -> None:
    """A door in the wall on the left of a place: a gap, barred if one of its sides is locked."""
    pen.box(x - 4, y + 92, 8, 72, _SHUT if shut else _FLOOR, ink=_SHUT if shut else _FLOOR)
    for edge in (92, 164):
        pen.line(x - 10, y + edge, x + 10, y + edge, _WALL, 3)


def _draw_lock(pen: _Pen, x: float, y: float, words: str, shut: bool) -> None:
    colour = _SHUT if shut else _OPEN
    lift, aside = (0, 0) if shut else (3, 8)
    pen.arc(x - 44 + aside, y - 5 - lift, 6, colour, 3)
    pen.box(x - 53, y - 4, 18, 14, colour, radius=2, ink=colour)
    pen.text(x - 24, y + 3, words, 14, colour, "lm")


def _draw_robot(
    pen: _Pen, x: float, y: float, name: str, held: tuple[str, ...], covers: dict[str, str]
) -> None:
    pen.line(x, y - 34, x, y - 24, _BODY, 3)
    pen.dot(x, y - 36, 4, _SHUT)
    pen.box(x - 20, y - 26, 40, 28, _FACE, radius=8, edge=3, ink=_BODY)
    pen.dot(x - 8, y - 12, 4, _INK)
    pen.dot(x + 8, y - 12, 4, _INK)
    pen.box(x - 26, y + 6, 52, 44, _BODY, radius=8, ink=_BODY)
    pen.text(x, y + 28, name, 14, _PAPER)
    pen.dot(x - 14, y + 56, 7, _WALL)
    pen.dot(x + 14, y + 56, 7, _WALL)
    pen.line(x + 24, y + 18, x + 52, y + 6, _BODY, 6)
    pen.dot(x + 53, y + 5, 6, _BODY)
    for number, thing in enumerate(held):
        _draw_book(pen, x + 46, y - 32 - 40 * number, thing, covers)


def _draw_book(pen: _Pen, x: float, y: float, name: str, covers: dict[str, str]) -> None:
    pen.box(x, y, 60, 34, covers[name], radius=3, ink=covers[name])
    pen.box(x + 5, y + 28, 52, 4, _PAPER, ink=_PAPER)
    pen.line(x + 6, y, x + 6, y + 28, _PAPER, 1)
    pen.text(x + 33, y + 14, name, 13, _PAPER)


def _draw_caption(pen: _Pen, scene: Scene, y: float) -> None:
    pen.text(_EDGE, y + 8, f"step {scene.step}", 18, _INK, "lm")
    pen.text(_EDGE + 110, y + 8, scene.outcome.replace("_", " "), 18, _SHUT, "lm")
    before = f"robot: {scene.robot or '-'}     adversary: {scene.adversary or '-'}"
    pen.text(_EDGE, y + 36, f"just now    {before}", 15, _FAINT, "lm")
    if scene.rest:
        pen.text(_EDGE, y + 58, f"also true: {', '.join(scene.rest)}", 15, _FAINT, "lm")
