"""What a game asks of a world, however the world finds its answers."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Protocol

from asp.language import Description


class Dynamics(Protocol):
    """States, transitions and views of a domain; a state is an integer, one bit a fluent.

    Every method is a pure function of the state, and documented in `World`.
    """

    description: Description
    fluents: tuple[str, ...]
    agent_actions: tuple[str, ...]
    exogenous_actions: tuple[str, ...]

    def state(self, literals: Iterable[str]) -> int: ...

    def literals(self, state: int) -> tuple[str, ...]: ...

    def true_atoms(self, state: int) -> tuple[str, ...]: ...

    def holds(self, state: int, literal: str) -> bool: ...

    def satisfies(self, state: int, literals: Iterable[str]) -> bool: ...

    def successors(self, state: int, actions: Iterable[str]) -> tuple[int, ...]: ...

    def executable(self, state: int, actions: Iterable[str]) -> bool: ...

    def why_not(self, state: int, actions: Iterable[str]) -> str | None: ...

    def visible(self, state: int, robot: str) -> tuple[str, ...]: ...
