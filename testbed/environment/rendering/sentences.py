"""A drawing in words, for those who hear it."""

from collections.abc import Iterator, Sequence

from testbed.environment.rendering.contents import Contents
from testbed.environment.rendering.scene import Place, Scene


def sentences(scene: Scene, told: Contents) -> Iterator[str]:
    """A sentence per place, with all that is there, and per other fluent."""
    for place in scene.places:
        marks = [
            _word(name if true else f"not {name}", (place.name, name), told)
            for name, true in place.marks.items()
        ]
        inside = [_spoken(name, place, told, held) for name, held in place.robots.items()]
        inside += [_spoken(name, place, told) for name in place.things]
        said = f"{place.name}{''.join(f', {mark}' for mark in marks)}"
        ways = f", next to {', '.join(sorted(place.next_to))}" if place.next_to else ""
        yield f"{said}{ways}: {', '.join(inside) or 'nothing'}"
    for atom in told.standing:
        yield _word(atom, atom.arguments[0], told)
    yield from (_word(atom, atom, told) for atom in told.rest)
    yield from (f"not believed: {literal}" for literal in told.missing)


def _spoken(name: str, place: Place, told: Contents, held: Sequence[str] = ()) -> str:
    cell = f" in {place.spots[name]}" if name in place.spots else ""
    notes = "".join(f" ({note})" for note in told.notes.get(name, ()))
    others = " and ".join(
        _word(t, t, told) + "".join(f" ({note})" for note in told.notes.get(t, ())) for t in held
    )
    return _word(name, name, told) + cell + notes + (f" with {others}" if held else "")


def _word(text: str, key: object, told: Contents) -> str:
    return f"{text}, which differs" if key in told.differs else text
