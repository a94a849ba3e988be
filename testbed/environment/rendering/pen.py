"""Drawing on a canvas without a screen: shapes, lines and words, in the colours of a picture."""

from __future__ import annotations

from typing import Any, TypeAlias

import numpy as np
from numpy.typing import NDArray
from PIL import Image as Pillow
from PIL import ImageDraw, ImageFont

Image: TypeAlias = NDArray[np.uint8]
"""Height x width x 3."""

PAPER, FLOOR, WALL, INK, FAINT = "#ffffff", "#f6f1e7", "#4a4a4a", "#222222", "#777777"
SHUT, OPEN, BODY, FACE = "#c0392b", "#2e8b57", "#3d6ea5", "#dbe9f6"

_FINER = 2  # drawn so many times larger and scaled down, for smooth edges


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
