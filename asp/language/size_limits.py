"""How large a description may be when it is instantiated: told before that is tried."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from math import prod
from typing import TypeVar

from asp.language import syntax
from asp.language.checker import variable_domains
from asp.language.signature import Problems, Signature

MOST_SYMBOLS = 500_000
"""Ground fluents and actions of a description."""
MOST_INSTANCES = 5_000_000
"""Instances of all statements of a description, those included that their bodies rule out."""

S = TypeVar("S", bound=syntax.Statement)


def check_sizes(source: syntax.Source, signature: Signature, problems: Problems) -> None:
    """Reports what has most instances where there are too many of them."""
    declared = [own for own in signature.symbols.values() if own.kind != "static"]
    _check(
        declared,
        lambda own: prod(len(signature.sorts[sort.name]) for sort in own.sorts),
        MOST_SYMBOLS,
        "all fluents and actions together",
        problems,
    )
    _check(
        _instantiated(source),
        lambda own: prod(map(len, variable_domains(own, signature).values())),
        MOST_INSTANCES,
        "all statements together",
        problems,
    )


def _instantiated(source: syntax.Source) -> list[syntax.Statement]:
    others = syntax.SortDefinition | syntax.Declaration
    return [own for own in source.statements if not isinstance(own, others)]


def _check(
    items: Iterable[S], size: Callable[[S], int], most: int, whose: str, problems: Problems
) -> None:
    sizes = [(size(item), item) for item in items]
    if sum(number for number, _ in sizes) > most:
        number, largest = max(sizes, key=lambda own: own[0])
        problems.report(
            largest.place, f"has {number} instances; {most} are the most for {whose}: smaller sorts"
        )
