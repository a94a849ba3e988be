"""Parts of a drawing in SVG: each knows its size, and larger ones are laid out of smaller ones.

Lengths are pixels of a drawing that is shown in its own size. How wide a text comes out is not
known here: it is taken to be as wide as in most fonts, and what is too long for its place is
shortened, with all of it as its title. Colours are the variables of the page around it.
"""

from collections.abc import Iterable, Sequence
from dataclasses import dataclass

from markupsafe import Markup

GAP = 6
DIFFERS, MISSING = "≠", "?"
"""The signs of what is drawn and is not so, and of what is so and is not drawn."""
_SIZE, _SMALL, _WIDE = 12, 10, 0.58
"""Of letters; their width as a part of it."""
PAD, _HEAD, _LINE, _GLYPH, _SIGN = 6, 22, 13, 20, 14
_HUES = ("first", "second", "others", "mental")

_BOX = '<rect width="{w:.0f}" height="{h:.0f}" rx="5" fill="var(--page)" stroke="var(--'
_PLAIN = Markup(_BOX + 'line)"/>')
_BODY = Markup(_BOX + 'link)"/>')
_DASHED = Markup(_BOX + 'others)" stroke-width="2" stroke-dasharray="5 3"/>')
_TEXT = Markup('<text x="{x:g}" y="{y:g}"{look}>{text}</text>')
_TITLED = Markup("<title>{whole}</title>{short}")
_MOVED = Markup('<g transform="translate({x:.4g} {y:.4g})">{svg}</g>')
_ROBOT = Markup(
    '<g transform="translate(3 3)" stroke="var(--link)">'
    '<path d="M8 0v4M2 4h12v8H2zM4 15h8" fill="none"/><path d="M5.5 7v2M10.5 7v2"/></g>'
)
_THING = Markup(
    '<path d="M6 7l5-3 5 3v7l-5 3-5-3zM6 7l5 3 5-3M11 10v7" fill="none" stroke="var(--{hue})"/>'
)
_MARK = Markup('<path d="M4 11l4-5h9v10H8z"{look}/>')
_FALSE = Markup(' fill="none" stroke="var(--soft)"')
PLAIN, SOFT = Markup(""), Markup(' fill="var(--soft)" font-size="10"')
STRONG = Markup(' font-weight="600"')
_SIGNED = Markup(' fill="var(--others)" font-weight="700" font-size="14"')


@dataclass(frozen=True)
class Block:
    """A part of a drawing, from its left upper corner on."""

    width: float
    height: float
    svg: Markup

    def at(self, x: float, y: float) -> Markup:
        """The part where it stands in a larger one."""
        return _MOVED.format(x=x, y=y, svg=self.svg) if self.svg and (x or y) else self.svg


def words(text: str, x: float, y: float, most: float, look: Markup = PLAIN) -> Markup:
    """A line of text on the base line y, at most so wide."""
    fit = max(2, int(most / _letter(look) + 0.05))
    shown: str | Markup = text
    if len(text) > fit:
        shown = _TITLED.format(whole=text, short=f"{text[: fit - 1]}…")
    return _TEXT.format(x=x, y=y, look=look, text=shown)


def wide(text: str, look: Markup = PLAIN) -> float:
    """The width that a text is taken to have."""
    return len(text) * _letter(look)


def _letter(look: Markup) -> float:
    return _WIDE * (_SMALL if look is SOFT else _SIZE)


def card(
    name: str,
    notes: Sequence[str] = (),
    held: Sequence[Block] = (),
    *,
    most: float,
    sign: str = "",
    glyph: Markup = PLAIN,
    look: Markup = _PLAIN,
    least: float = 0,
) -> Block:
    """A name in a box with what is said of it, and below it what it holds, at most so wide."""
    if _GLYPH + wide(name) > most:
        glyph = PLAIN
    left = _GLYPH if glyph else PAD
    right = PAD + (_SIGN if sign else 0)
    needed = (
        left + wide(name) + right,
        *(left + wide(note, SOFT) + PAD for note in notes),
        *(block.width + 2 * PAD for block in held),
    )
    width = min(most, max(least, *needed))
    lines = [words(name, left, 15, width - left - right + PAD / 2)]
    lines += [
        words(note, left, _HEAD + 6 + _LINE * number, width - left - PAD, SOFT)
        for number, note in enumerate(notes)
    ]
    if sign:
        lines.append(_TEXT.format(x=width - _SIGN - 2, y=16, look=_SIGNED, text=sign))
    below = column(held)
    top = _HEAD + _LINE * len(notes)
    height = top + (below.height + PAD if held else 0)
    box = _DASHED if sign else look
    drawn = [box.format(w=width - 1, h=height - 1), glyph, *lines, below.at(PAD, top)]
    return Block(width, height, Markup("").join(drawn))


def robot(name: str, notes: Sequence[str], held: Sequence[Block], most: float, sign: str) -> Block:
    """A robot with what it holds."""
    return card(name, notes, held, most=most, sign=sign, glyph=_ROBOT, look=_BODY)


def thing(name: str, notes: Sequence[str], most: float, sign: str) -> Block:
    """A thing, always in the same colour."""
    hue = _HUES[sum(map(ord, name)) % len(_HUES)]
    return card(name, notes, most=most, sign=sign, glyph=_THING.format(hue=hue))


def mark(name: str, true: bool, most: float, sign: str) -> Block:
    """A mark of a place, as a tag that is filled where it is true and hollow where it is not."""
    glyph = _MARK.format(look=PLAIN if true else _FALSE)
    return card(name if true else f"not {name}", most=most, sign=sign, glyph=glyph)


def column(blocks: Iterable[Block]) -> Block:
    """Blocks below each other."""
    y, width, drawn = 0.0, 0.0, []
    for block in blocks:
        drawn.append(block.at(0, y))
        y, width = y + block.height + GAP, max(width, block.width)
    return Block(width, max(0, y - GAP), Markup("").join(drawn))


def row(blocks: Sequence[Block]) -> Block:
    """Blocks beside each other, on one base line."""
    x, height, drawn = 0.0, max((block.height for block in blocks), default=0), []
    for block in blocks:
        drawn.append(block.at(x, height - block.height))
        x += block.width + GAP
    return Block(max(0, x - GAP), height, Markup("").join(drawn))


def flow(blocks: Iterable[Block], most: float) -> Block:
    """Blocks in rows as wide as given at most, each as full as it can be."""
    rows: list[list[Block]] = []
    x = most
    for block in blocks:
        if not rows or x + block.width > most:
            rows.append([])
            x = 0
        rows[-1].append(block)
        x += block.width + GAP
    return column(map(row, rows))
