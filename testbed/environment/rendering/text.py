"""A scene as a few lines of text."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import pairwise

from testbed.environment.rendering.scene import Place, Scene

_SMALLEST = 18


def draw_text(scene: Scene) -> str:
    """The places side by side, an open wall (`=`) between neighbours, and a caption."""
    return "\n".join([*_rooms(scene), *_caption(scene)])


def _rooms(scene: Scene) -> Iterator[str]:
    if not scene.places:
        return
    columns = [list(_lines(place)) for place in scene.places]
    width = max([_SMALLEST, *(len(line) for column in columns for line in column)])
    rule = "+" + "+".join(["-" * (width + 2)] * len(columns)) + "+"
    yield rule
    for number in range(max(map(len, columns))):
        yield _row(scene, columns, number, width)
    yield rule


def _lines(place: Place) -> Iterator[str]:
    marks = [name if true else f"not {name}" for name, true in place.marks.items()]
    yield place.name + (f" ({', '.join(marks)})" if marks else "")
    for robot, held in place.robots.items():
        yield f"[{robot}]{_spot(place, robot)}" + (f" holds {', '.join(held)}" if held else "")
    yield from (thing + _spot(place, thing) for thing in place.things)


def _spot(place: Place, thing: str) -> str:
    return f" in {place.spots[thing]}" if thing in place.spots else ""


def _row(scene: Scene, columns: list[list[str]], number: int, width: int) -> str:
    cells = [(column[number] if number < len(column) else "").ljust(width) for column in columns]
    walls = ["=" if b.name in a.next_to and number == 0 else "|" for a, b in pairwise(scene.places)]
    return (
        "| " + "".join(f"{c} {w} " for c, w in zip(cells, walls, strict=False)) + f"{cells[-1]} |"
    )


def _caption(scene: Scene) -> Iterator[str]:
    done = f"  before it: {scene.robot}" if scene.robot else ""
    beside = f" beside {scene.adversary}" if scene.adversary not in ("", "none") else ""
    yield f"step {scene.step}{done}{beside}" + (f"  [{scene.outcome}]" if scene.outcome else "")
    if scene.rest:
        yield f"also true: {', '.join(scene.rest)}"
