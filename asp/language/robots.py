"""Whose actions a description is about: those of one robot, or of several."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from asp.language import syntax
from asp.language.errors import SourceError
from asp.language.loading import analyse, parse_description
from asp.language.signature import Signature


def check_one_robot(text: str, file: str) -> None:
    """Check that the actions of a description are those of one robot.

    The robot is the first constant that sees something. A second one is a constant that can take
    its place in each action; or one that sees, too, and has actions, but no part in the first's.

    Raises:
        SourceError: at the sort that has the second robot; or for a mistake in the text.
    """
    seers = parse_description(text, file).robots
    source, signature = analyse(text, file)
    second = next(_second(seers, signature), None)
    if second is not None:
        place = _declared(second, source)
        raise SourceError(
            file,
            place.line,
            place.column,
            f"{seers[0]} and {second} are two robots, and a description has one for now; "
            f"drop {second}, or give what is no robot a sort of its own",
        )


def _second(seers: Sequence[str], signature: Signature) -> Iterator[str]:
    for robot in seers[:1]:
        own = [places for places in _places(signature) if any(robot in sort for sort in places)]
        alike = [{c for sort in places if robot in sort for c in sort} for places in own]
        if len(own) == len(_places(signature)):
            yield from sorted(set.intersection(*alike) - {robot}) if own else ()
        acted_upon = {constant for places in own for sort in places for constant in sort}
        acting = {c for places in _places(signature) for sort in places for c in sort}
        yield from (seer for seer in seers[1:] if own and seer in acting - acted_upon)


def _places(signature: Signature) -> list[list[tuple[str, ...]]]:
    """The members of the sorts of the arguments, by action of an agent."""
    actions = [symbol for symbol in signature.symbols.values() if symbol.kind == "agent"]
    return [[signature.sorts[sort.name] for sort in action.sorts] for action in actions]


def _declared(constant: str, source: syntax.Source) -> syntax.Place:
    """Where the sort stands that lists the constant."""
    sorts = source.each(syntax.SortDefinition)
    return next(s.place for s in sorts if any(constant == t.name for t in _listed(s)))


def _listed(definition: syntax.SortDefinition) -> list[syntax.Term]:
    return [term for part in definition.parts if isinstance(part, tuple) for term in part]
