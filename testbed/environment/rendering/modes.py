"""How a game is shown: as text, as a picture, on the terminal, and in a notebook."""

from __future__ import annotations

from base64 import b64encode
from io import BytesIO

from markupsafe import Markup
from PIL import Image as Pillow

from testbed.environment.core import Core
from testbed.environment.rendering.picture import Image, draw_picture
from testbed.environment.rendering.scene import Scene, scene
from testbed.environment.rendering.text import draw_text

_FIGURE = Markup(
    '<figure style="margin:0"><img style="max-width:100%" alt="{alt}"'
    ' src="data:image/png;base64,{png}"><figcaption>{caption}</figcaption></figure>'
)

MODES = ("human", "ansi", "rgb_array")


def check_mode(mode: str | None) -> None:
    """Raises ValueError for a mode that is none."""
    if mode is not None and mode not in MODES:
        raise ValueError(f"{mode!r} is not a render mode; there are {', '.join(MODES)}")


def render(core: Core, mode: str | None) -> str | Image | None:
    """The situation in a mode; None for `human`, which prints, and where there is no mode."""
    if mode == "ansi":
        return draw_text(_scene(core))
    if mode == "rgb_array":
        return draw_picture(_scene(core))
    if mode == "human":
        print(draw_text(_scene(core)))
    return None


def html_of(core: Core) -> str:
    """The situation as HTML that stands by itself; text where no game has begun."""
    if not core.begun:
        return str(Markup("<p>{}</p>").format(f"{core.world.description.name}: no game has begun"))
    shown = _scene(core)
    picture = BytesIO()
    Pillow.fromarray(draw_picture(shown)).save(picture, "PNG")
    goal = ", ".join(core.situation.goal)
    stands = core.situation.ending or f"step {core.situation.step} of {core.rules.steps}"
    return str(
        _FIGURE.format(
            alt=draw_text(shown),
            png=b64encode(picture.getvalue()).decode(),
            caption=f"{core.world.description.name}, {stands}; goal: {goal}",
        )
    )


def _scene(core: Core) -> Scene:
    return scene(core.world, core.situation, core.robot)
