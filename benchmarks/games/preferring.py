"""Which of the smallest explanations comes first in the order that `docs/theory.md` states."""

from itertools import islice
from typing import Any

from benchmarks.games.explaining import Assumptions, Price, Search

MOST_COMPARED = 60


def first(search: Search, price: Price) -> Assumptions | None:
    """The first of the smallest explanations, whose price this is; None: there are too many."""
    every = list(islice(search.every(price), MOST_COMPARED + 1))
    if len(every) > MOST_COMPARED:
        return None
    return min(every, key=lambda assumed: _place(search, assumed))


def _place(search: Search, assumed: Assumptions) -> tuple[Any, ...]:
    """What is smaller comes first.

    Reports are believed, the latest before others; exceptions are those to the defaults declared
    last; unknown fluents are false, those declared last before others; events are late rather than
    early, and at a step those that are declared first.
    """
    office = search.told.rules.office
    distrusted, events = (
        sorted((-step, office.events.index(action)) for step, action in some)
        for some in (assumed.distrusted, assumed.events)
    )
    starts = (office.fluents(node.state) for node in search.explained(assumed))
    return (
        tuple((-step, -rank) for step, rank in distrusted),
        tuple(-rank for rank in sorted(map(office.defaults.index, assumed.exceptions))),
        min(tuple(sorted(map(office.atoms.index, true), reverse=True)) for true in starts),
        tuple(events),
    )
