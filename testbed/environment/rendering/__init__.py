"""A game as text, as a picture, on the terminal, and in a notebook."""

from base64 import b64encode
from collections.abc import Iterator, Sequence
from io import BytesIO
from itertools import chain, pairwise, zip_longest

from markupsafe import Markup
from PIL import Image as Pillow

from testbed.environment.core import Core
from testbed.environment.rendering.picture import Image as Image
from testbed.environment.rendering.picture import draw_picture as draw_picture
from testbed.environment.rendering.scene import Place
from testbed.environment.rendering.scene import Scene as Scene
from testbed.environment.rendering.scene import Stage as Stage
from testbed.environment.rendering.scene import scene as scene
from testbed.environment.rendering.svg import draw_svg as draw_svg
from testbed.environment.rendering.window import Window as Window
from testbed.environment.rules import NotResetError

FIGURE = Markup(
    '<figure style="margin:0"><img style="max-width:100%" alt="{alt}"'
    ' src="data:image/png;base64,{png}"><figcaption>{caption}</figcaption></figure>'
)
MODES = ("human", "ansi", "rgb_array")
SMALLEST = 18
"""Characters of the width of a place."""


def render(core: Core, mode: str | None, window: Window) -> str | Image | None:
    """The situation in a mode; None for `human`, and where there is no mode.

    `human` shows the picture in the window, and prints the text where there is no screen for one.
    """
    if mode is None:
        return None
    shown = scene(core.world, core.situation, core.robot)
    if mode == "rgb_array":
        return draw_picture(shown)
    if mode == "ansi":
        return draw_text(shown)
    if not window.show(draw_picture(shown)):
        print(draw_text(shown))
    return None


def html_of(core: Core) -> str:
    """The situation as HTML that stands by itself; text where no game has begun."""
    domain = core.world.description.name
    try:
        now = core.situation
    except NotResetError:
        return str(Markup("<p>{}</p>").format(f"{domain}: no game has begun"))
    shown = scene(core.world, now, core.robot)
    picture = BytesIO()
    Pillow.fromarray(draw_picture(shown)).save(picture, "PNG")
    stands = now.ending or f"step {now.step} of {core.rules.steps}"
    caption = f"{domain}, {stands}; goal: {', '.join(now.goal)}"
    png = b64encode(picture.getvalue()).decode()
    return str(FIGURE.format(alt=draw_text(shown), png=png, caption=caption))


def draw_text(scene: Scene, width: int | None = None) -> str:
    """The places side by side, an open wall (`=`) between neighbours, and a caption.

    Without a `width` all places stand in one row.
    """
    columns = [list(_lines(place)) for place in scene.places]
    widest = max([SMALLEST, *(len(line) for column in columns for line in column)])
    a_row = len(columns) if width is None else max(1, (width - 1) // (widest + 3))
    rows = (
        _row(scene.places[at : at + a_row], columns[at : at + a_row], widest)
        for at in range(0, len(columns), max(1, a_row))
    )
    return "\n".join([*chain.from_iterable(rows), *_caption(scene)])


def _row(places: Sequence[Place], columns: Sequence[list[str]], width: int) -> Iterator[str]:
    doors = ["=" if b.name in a.next_to else "|" for a, b in pairwise(places)]
    rule = "+" + "+".join(["-" * (width + 2)] * len(columns)) + "+"
    yield rule
    for number, row in enumerate(zip_longest(*columns, fillvalue="")):
        walls = [*(doors if number == 0 else "|" * len(doors)), "|"]
        yield "| " + " ".join(f"{c:{width}} {w}" for c, w in zip(row, walls, strict=True))
    yield rule


def _lines(place: Place) -> Iterator[str]:
    marks = [name if true else f"not {name}" for name, true in place.marks.items()]
    yield place.name + (f" ({', '.join(marks)})" if marks else "")
    for robot, held in place.robots.items():
        yield f"[{robot}]{_spot(place, robot)}" + (f" holds {', '.join(held)}" if held else "")
    yield from (thing + _spot(place, thing) for thing in place.things)


def _spot(place: Place, thing: str) -> str:
    return f" in {place.spots[thing]}" if thing in place.spots else ""


def _caption(scene: Scene) -> Iterator[str]:
    done = f"  before it: {scene.robot}" if scene.robot else ""
    beside = f" beside {scene.adversary}" if scene.adversary not in ("", "none") else ""
    yield f"step {scene.step}{done}{beside}" + (f"  [{scene.outcome}]" if scene.outcome else "")
    if scene.rest:
        yield f"also true: {', '.join(scene.rest)}"
