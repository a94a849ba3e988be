"""The render modes: text, a picture, or text on the terminal. None of them needs a screen."""

from __future__ import annotations

from testbed.environment.core import Core
from testbed.environment.rendering.ansi import draw_text
from testbed.environment.rendering.picture import Image, draw_picture
from testbed.environment.rendering.scene import scene

MODES = ("human", "ansi", "rgb_array")


def check_mode(mode: str | None) -> None:
    """Raises ValueError for a mode that is none."""
    if mode is not None and mode not in MODES:
        raise ValueError(f"{mode!r} is not a render mode; there are {', '.join(MODES)}")


def render(core: Core, mode: str | None) -> str | Image | None:
    """The situation in a mode; None for `human`, which prints, and where there is no mode."""
    if mode == "ansi":
        return draw_text(scene(core))
    if mode == "rgb_array":
        return draw_picture(scene(core))
    if mode == "human":
        print(draw_text(scene(core)))
    return None
