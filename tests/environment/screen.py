"""A toolkit for windows of matplotlib that notes what it is to show: a screen, for tests."""

from typing import Any

from matplotlib.backend_bases import FigureManagerBase
from matplotlib.backends.backend_agg import FigureCanvasAgg

shown: list[Any] = []
"""The windows that were opened, and not closed, as figures."""
drawn: list[bytes] = []
"""What was drawn in them, as pixels."""


class FigureManager(FigureManagerBase):
    """A window."""

    def show(self) -> None:
        shown.append(self.canvas.figure)

    def destroy(self, *_: object) -> None:
        shown.remove(self.canvas.figure)


class FigureCanvas(FigureCanvasAgg):
    """What is in it."""

    required_interactive_framework = None
    manager_class = FigureManager

    def draw_idle(self, *_: object, **__: object) -> None:
        self.draw()
        drawn.append(bytes(self.buffer_rgba()))
