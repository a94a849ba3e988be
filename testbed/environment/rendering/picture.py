"""A scene as a picture: places in rows with ways between them, things, robots, and marks.

Of a place of several cells a grid, and in each cell what is there. None of it needs a screen. It is
drawn twice as large and scaled down, for smooth edges: lengths below are those of the large one.
"""

from collections.abc import Mapping
from itertools import pairwise
from math import ceil, sqrt
from typing import TypeAlias

import numpy as np
from numpy.typing import NDArray
from PIL import Image as Pillow
from PIL.ImageDraw import Draw, ImageDraw

from testbed.environment.rendering.scene import Place, Scene

Image: TypeAlias = NDArray[np.uint8]
"""Height x width x 3."""

PAPER, FLOOR, WALL, INK, FAINT = "#ffffff", "#f6f1e7", "#4a4a4a", "#222222", "#777777"
ALERT, BODY, FACE = "#c0392b", "#3d6ea5", "#dbe9f6"
HUES = ("#b5532a", "#6a8f3c", "#7b5ea7", "#c29a2b", "#3a8f8f", "#a8486f")

_WIDE, _TALL, _EDGE, _FOOT, _PER_ROW = 460, 500, 40, 148, 4
_STRIP, _HEAD, _INDENT, _SMALL = 20, 26, 16, 16

Box = tuple[float, float, float, float]
"""Left, top, right, bottom."""
Colours = Mapping[str, str]
"""A colour for each thing."""


def draw_picture(scene: Scene) -> Image:
    """The picture as an array of shape (height, width, 3)."""
    columns = max(1, min(_PER_ROW, len(scene.places)))
    rows = -(-len(scene.places) // _PER_ROW)
    width, height = columns * _WIDE + 2 * _EDGE, rows * _TALL + 2 * _EDGE + _FOOT
    image = Pillow.new("RGB", (width, height), PAPER)
    draw, colours = Draw(image), _colours(scene)
    for number, place in enumerate(scene.places):
        _draw_place(draw, place, *_corner(number), colours)
    for number, (left, right) in enumerate(pairwise(scene.places)):
        if right.name in left.next_to and (number + 1) % _PER_ROW:
            _draw_way(draw, *_corner(number + 1))
    _draw_caption(draw, scene, rows * _TALL + 2 * _EDGE)
    return np.asarray(image.resize((width // 2, height // 2), Pillow.Resampling.LANCZOS))


def _corner(number: int) -> tuple[int, int]:
    row, column = divmod(number, _PER_ROW)
    return _EDGE + column * _WIDE, _EDGE + row * _TALL


def _colours(scene: Scene) -> Colours:
    """The same in every picture of a domain."""
    held = [t for p in scene.places for things in p.robots.values() for t in things]
    things = sorted({*held, *(t for p in scene.places for t in p.things)})
    return {thing: HUES[i % len(HUES)] for i, thing in enumerate(things)}


def _draw_place(draw: ImageDraw, place: Place, x: int, y: int, colours: Colours) -> None:
    draw.rectangle((x, y, x + _WIDE, y + _TALL), FLOOR, WALL, 6)
    draw.text((x + _WIDE / 2, y + 44), place.name, INK, anchor="mm", font_size=36)
    for name, true in place.marks.items():
        _draw_mark(draw, x + _WIDE / 2, y + 104, name if true else f"not {name}", true)
    if place.cells:
        head = 128 if place.marks else 80
        _draw_cells(draw, place, (x + 28, y + head, x + _WIDE - 28, y + _TALL - 24), colours)
        return
    for number, (robot, held) in enumerate(place.robots.items()):
        _draw_robot(draw, x + 124 + 160 * number, y + 236, robot, held, colours)
    for number, thing in enumerate(place.things):
        row, column = divmod(number, 3)
        from_left = 2 - column if row else column  # a second layer grows away from the robots
        _draw_thing(draw, x + 36 + 136 * from_left, y + 404 - 88 * row, thing, colours)


def _draw_way(draw: ImageDraw, x: int, y: int) -> None:
    """A gap in the wall on the left of a place."""
    draw.rectangle((x - 8, y + 184, x + 8, y + 328), FLOOR)
    for edge in (184, 328):
        draw.line((x - 20, y + edge, x + 20, y + edge), WALL, 6)


def _draw_mark(draw: ImageDraw, x: float, y: float, words: str, true: bool) -> None:
    """A tag that is filled where the mark is true, and hollow where it is not."""
    ink = INK if true else FAINT
    tag = ((-106, 6), (-92, -10), (-64, -10), (-64, 22), (-92, 22))
    draw.polygon([(x + right, y + down) for right, down in tag], ink if true else PAPER, ink, 4)
    draw.text((x - 48, y + 6), words, ink, anchor="lm", font_size=28)


def _draw_robot(
    draw: ImageDraw, x: float, y: float, name: str, held: tuple[str, ...], colours: Colours
) -> None:
    draw.line((x, y - 68, x, y - 48), BODY, 6)
    draw.circle((x, y - 72), 8, ALERT)
    draw.rounded_rectangle((x - 40, y - 52, x + 40, y + 4), 16, FACE, BODY, 6)
    draw.rounded_rectangle((x - 52, y + 12, x + 52, y + 100), 16, BODY)
    draw.text((x, y + 56), name, PAPER, anchor="mm", font_size=28)
    for side in (-1, 1):
        draw.circle((x + 16 * side, y - 24), 8, INK)
        draw.circle((x + 28 * side, y + 112), 14, WALL)
    draw.line((x + 48, y + 36, x + 104, y + 12), BODY, 12)
    draw.circle((x + 106, y + 10), 12, BODY)
    for number, thing in enumerate(held):
        _draw_thing(draw, x + 92, y - 64 - 80 * number, thing, colours)


def _draw_thing(draw: ImageDraw, x: float, y: float, name: str, colours: Colours) -> None:
    draw.rounded_rectangle((x, y, x + 120, y + 68), 6, colours[name])
    draw.text((x + 60, y + 34), name, PAPER, anchor="mm", font_size=26)


def _draw_caption(draw: ImageDraw, scene: Scene, y: float) -> None:
    before = f"just now    robot: {scene.robot or '-'}     adversary: {scene.adversary or '-'}"
    rest = f"also true: {', '.join(scene.rest)}" if scene.rest else ""
    outcome = scene.outcome.replace("_", " ")
    for left, down, words, ink, size in (
        (0, 16, f"step {scene.step}", INK, 36),
        (220, 16, outcome, ALERT, 36),
        (0, 72, before, FAINT, 30),
        (0, 116, rest, FAINT, 30),
    ):
        draw.text((_EDGE + left, y + down), words, ink, anchor="lm", font_size=size)


def _draw_cells(draw: ImageDraw, place: Place, box: Box, colours: Colours) -> None:
    """The cells row by row in their order, in as many columns as rows or one more.

    The order is that of the description: it does not say how cells lie to each other.
    """
    left, top, right, bottom = box
    columns = ceil(sqrt(len(place.cells)))
    wide = (right - left) / columns
    tall = (bottom - top) / ceil(len(place.cells) / columns)
    for number, cell in enumerate(place.cells):
        row, column = divmod(number, columns)
        x, y = left + column * wide, top + row * tall
        _draw_cell(draw, place, cell, (x, y, x + wide, y + tall), colours)


def _draw_cell(draw: ImageDraw, place: Place, cell: str, box: Box, colours: Colours) -> None:
    left, top, right, bottom = box
    draw.rectangle(box, PAPER, WALL, 2)
    label = cell.removeprefix(place.name).lstrip("_") or cell
    draw.text((left + 8, top + 14), label, FAINT, anchor="lm", font_size=_SMALL)
    strips = _strips(place, cell, colours)
    fit = max(1, int((bottom - top - _HEAD) // (_STRIP + 2)))
    if len(strips) > fit:
        strips = [*strips[: fit - 1], (f"and {len(strips) - fit + 1} more", FAINT, 0)]
    for number, (name, colour, indent) in enumerate(strips):
        x, y = left + 6 + indent, top + _HEAD + number * (_STRIP + 2)
        draw.rounded_rectangle((x, y, right - 6, y + _STRIP), 6, colour)
        middle = ((x + right - 6) / 2, y + _STRIP / 2)
        draw.text(middle, name, PAPER, anchor="mm", font_size=_SMALL)


def _strips(place: Place, cell: str, colours: Colours) -> list[tuple[str, str, int]]:
    """What is in a cell, with colours; what a robot holds stands under it, indented."""
    strips = []
    for robot, held in place.robots.items():
        if place.spots[robot] == cell:
            strips += [(robot, BODY, 0), *((thing, colours[thing], _INDENT) for thing in held)]
    lying = [thing for thing in place.things if place.spots[thing] == cell]
    return strips + [(thing, colours[thing], 0) for thing in lying]
