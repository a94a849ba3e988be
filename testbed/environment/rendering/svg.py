"""A scene as SVG for a page: rooms with doors between them and what is in them, or towers, or a
list, after what the description's signature shows. The same scene is always the same drawing.
"""

from collections.abc import Collection, Iterator, Sequence
from math import ceil, sqrt

from markupsafe import Markup

from asp.language import Literal
from testbed.environment.rendering.blocks import (
    DIFFERS,
    MISSING,
    PAD,
    SOFT,
    STRONG,
    Block,
    card,
    column,
    flow,
    mark,
    robot,
    row,
    thing,
    wide,
    words,
)
from testbed.environment.rendering.contents import Contents, contents
from testbed.environment.rendering.scene import Place, Scene
from testbed.environment.rendering.sentences import sentences

WIDTH = 360
"""Of each drawing: what a phone shows in its own size."""
FEW = 12
"""Places that are drawn in two columns, and with room for what may come into them."""
_PAD, _DOOR, _LEAST, _CELL = 8, 14, 84, 16

_SVG = Markup(
    '<svg xmlns="http://www.w3.org/2000/svg" viewBox="-1 -1 {width} {height:g}" role="img"'
    ' aria-label="{label}" width="100%" style="max-width:{most}px" font-size="12"'
    ' font-family="system-ui,sans-serif" fill="var(--ink)" stroke-width="1.5"'
    ' stroke-linejoin="round">{drawn}</svg>'
)
_ROOM = Markup(
    '<rect x="{x:g}" y="{y:g}" width="{w:g}" height="{h:g}" rx="9" fill="var(--card)"'
    ' stroke="var(--mental)"/>'
)
_OPENING = Markup('<path d="{d}" fill="var(--card)" stroke="var(--mental)"/>')
_DOOR_TO = Markup('<path d="M1 10V1h6v9" fill="none" stroke="var(--mental)"/>{name}')
_CELLS = Markup('<path d="{d}" fill="none" stroke="var(--line)" stroke-width="1"/>')


def draw_svg(scene: Scene, marked: Collection[Literal] = ()) -> str:
    """The drawing of a scene, with what is in these literals marked by shape and by word.

    They are those in which the scene, as somebody believes it, differs from another: a literal that
    holds there and not here, whether or not anything can be drawn of it.
    """
    told = contents(scene, marked)
    drawn = column([*_rooms(scene, told), *_below(told, "also true" * bool(scene.places))])
    label = ". ".join(sentences(scene, told)) or "nothing is true"
    most = WIDTH * 3 // 2
    return str(
        _SVG.format(
            width=WIDTH + 2, height=drawn.height + 2, label=label, most=most, drawn=drawn.svg
        )
    )


def _rooms(scene: Scene, told: Contents) -> Iterator[Block]:
    """All places as one block: in rows that are walked there and back, with the doors."""
    places = scene.places
    if not places:
        return
    columns = _columns(places)
    width = (WIDTH - _DOOR * (columns - 1)) / columns
    spots = {place.name: _spot(number, columns) for number, place in enumerate(places)}
    rooms = {place.name: _room(place, told, width, _beyond(place, spots)) for place in places}
    least = _LEAST if len(places) <= FEW else 0
    tall: dict[int, float] = {}
    for name, (line, _) in spots.items():
        tall[line] = max(tall.get(line, least), rooms[name].height)
    tops = {line: sum(tall[n] + _DOOR for n in range(line)) for line in tall}
    drawn = []
    for place in places:
        line, at = spots[place.name]
        x, y = at * (width + _DOOR), tops[line]
        drawn.append(_ROOM.format(x=x + 0.75, y=y + 0.75, w=width - 1.5, h=tall[line] - 1.5))
        drawn.append(rooms[place.name].at(x, y))
        drawn += _openings(place, spots, x, y, width, tall[line])
    yield Block(WIDTH, max(tops[n] + tall[n] for n in tall), Markup("").join(drawn))


def _columns(places: Sequence[Place]) -> int:
    if len(places) == 1 or any(len(place.cells) > 4 for place in places):
        return 1
    names = max(wide(place.name) for place in places)
    return 3 if len(places) > FEW and names < WIDTH / 3 - 3 * _PAD else 2


def _spot(number: int, columns: int) -> tuple[int, int]:
    """Row and column; each second row runs back, so that who walks on goes to the next one."""
    line, at = divmod(number, columns)
    return line, columns - 1 - at if line % 2 else at


Spots = dict[str, tuple[int, int]]


def _beyond(place: Place, spots: Spots) -> list[str]:
    """The neighbours that are not beside a place in the drawing."""
    line, at = spots[place.name]
    near = {(line, at - 1), (line, at + 1), (line - 1, at), (line + 1, at)}
    return [name for name in spots if name in place.next_to and spots[name] not in near]


def _openings(
    place: Place, spots: Spots, x: float, y: float, width: float, tall: float
) -> Iterator[Markup]:
    """The doors to the right and downwards."""
    line, at = spots[place.name]
    for name in place.next_to:
        match spots[name]:
            case (other, beside) if (other, beside) == (line, at + 1):
                half = min(12, tall / 5)
                top = y + tall / 2 - half
                d = f"M{x + width - 1.5:g} {top:g}h{_DOOR + 3}m0 {2 * half:g}h{-_DOOR - 3}"
                yield _OPENING.format(d=d)
            case (other, beside) if (other, beside) == (line + 1, at):
                middle = x + width / 2
                d = f"M{middle - 14:g} {y + tall - 1.5:g}v{_DOOR + 3}m28 0v{-_DOOR - 3}"
                yield _OPENING.format(d=d)


def _room(place: Place, told: Contents, width: float, beyond: Sequence[str]) -> Block:
    """The name of a place, its marks, what is in it, and where else it leads."""
    most = width - 2 * _PAD
    head = Block(most, 18, words(place.name, 0, 13, most, STRONG))
    marks = [
        mark(name, true, most, DIFFERS * ((place.name, name) in told.differs))
        for name, true in place.marks.items()
    ]
    lost = [name for name in (*place.robots, *place.things) if place.spots.get(name) is None]
    parts = [head, flow(marks, most)] if marks else [head]
    if place.cells:
        parts.append(_grid(place, told, most))
    parts.append(flow(_inside(place, told, lost, most), most))
    if beyond:
        parts.append(flow((_door(name, most) for name in beyond), most))
    inner = column(part for part in parts if part.height)
    return Block(width, inner.height + 2 * _PAD, inner.at(_PAD, _PAD))


def _door(name: str, most: float) -> Block:
    """A door to a place that is drawn elsewhere."""
    sign = _DOOR_TO.format(name=words(name, 11, 9, most - 11, SOFT))
    return Block(min(most, 11 + wide(name, SOFT)), 12, sign)


def _inside(place: Place, told: Contents, names: Collection[str], most: float) -> Iterator[Block]:
    for name, held in place.robots.items():
        if name in names:
            inside = [_thing(t, told, most - 2 * PAD) for t in held]
            yield robot(name, told.notes.get(name, ()), inside, most, _sign(name, told))
    for name in place.things:
        if name in names:
            yield _thing(name, told, most)


def _thing(name: str, told: Contents, most: float) -> Block:
    return thing(name, told.notes.get(name, ()), most, _sign(name, told))


def _sign(name: object, told: Contents) -> str:
    return DIFFERS if name in told.differs else ""


def _grid(place: Place, told: Contents, most: float) -> Block:
    """The cells row by row in their order, which does not say how they lie to each other."""
    columns = ceil(sqrt(len(place.cells)))
    width = most / columns
    y, path, drawn = 0.0, "", []
    for first in range(0, len(place.cells), columns):
        line = place.cells[first : first + columns]
        cells = [_cell(place, cell, told, width) for cell in line]
        tall = max(cell.height for cell in cells)
        for number, cell in enumerate(cells):
            drawn.append(cell.at(number * width, y))
            path += f"M{number * width:.4g} {y:g}h{width:.4g}v{tall:g}h{-width:.4g}z"
        y += tall
    return Block(most, y + 1, Markup("").join([_CELLS.format(d=path), *drawn]))


def _cell(place: Place, cell: str, told: Contents, width: float) -> Block:
    """What is in a cell, with its name where something is."""
    names = {name for name, spot in place.spots.items() if spot == cell}
    inside = column(_inside(place, told, names, width - 4))
    if not inside.height:
        return Block(width, _CELL, inside.svg)
    label = cell.removeprefix(place.name).lstrip("_") or cell
    name = words(label, 3, 10, width - 4, SOFT)
    return Block(width, inside.height + 16, name + inside.at(2, 13))


def _below(told: Contents, caption: str) -> Iterator[Block]:
    """Towers, and what is true and stands nowhere else."""
    listed = [*told.rest]
    towers = [_tower(name, told) for name in told.ground]
    if all(tower.width <= WIDTH for tower in towers):
        if towers:
            yield _caption(f"{told.relation}(above, below)")
            yield flow(towers, WIDTH)
    else:
        listed += told.standing
    if listed:
        yield from [_caption(caption)] * bool(caption)
        yield flow((card(atom, most=WIDTH, sign=_sign(atom, told)) for atom in listed), WIDTH)
    if told.missing:
        yield _caption("not believed")
        yield flow((card(atom, most=WIDTH, sign=MISSING) for atom in told.missing), WIDTH)


def _caption(text: str) -> Block:
    return Block(WIDTH, 12, words(text, 0, 10, WIDTH, SOFT))


def _tower(name: str, told: Contents) -> Block:
    """A thing below all that stands on it, as wide as that."""
    upper = row([_tower(other, told) for other in told.above.get(name, ())])
    notes, sign = told.notes.get(name, ()), _sign(name, told)
    base = card(name, notes, most=WIDTH * 4, sign=sign, least=upper.width)
    tall = upper.height + 2 if upper.height else 0
    width = max(base.width, upper.width)
    return Block(width, tall + base.height, upper.svg + base.at(0, tall))
