"""A game as a notebook shows it: its picture, its goal and how it stands."""

from __future__ import annotations

from base64 import b64encode
from io import BytesIO

from markupsafe import Markup
from PIL import Image

from testbed.environment.core import Core
from testbed.environment.rendering.ansi import draw_text
from testbed.environment.rendering.picture import draw_picture
from testbed.environment.rendering.scene import scene

_FIGURE = Markup(
    '<figure style="margin:0"><img style="max-width:100%" alt="{alt}"'
    ' src="data:image/png;base64,{png}"><figcaption>{caption}</figcaption></figure>'
)


def html_of(core: Core) -> str:
    """The situation as HTML that stands by itself; text where no game has begun."""
    if not core.begun:
        return str(Markup("<p>{}</p>").format(f"{core.world.description.name}: no game has begun"))
    shown = scene(core)
    picture = BytesIO()
    Image.fromarray(draw_picture(shown)).save(picture, "PNG")
    goal = ", ".join(core.situation.goal)
    stands = core.situation.ending or f"step {core.situation.step} of {core.rules.steps}"
    return str(
        _FIGURE.format(
            alt=draw_text(shown),
            png=b64encode(picture.getvalue()).decode(),
            caption=f"{core.world.description.name}, {stands}; goal: {goal}",
        )
    )
