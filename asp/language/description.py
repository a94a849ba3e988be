"""The ground description: everything that an AL_d text says, instance by instance."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property

Literals = tuple[str, ...]
"""Ground literals as ASP text, without blanks: `loc(book1,kitchen)`, `-locked(library)`."""


@dataclass(frozen=True)
class Causal:
    """`action causes head if body`."""

    action: str
    head: str
    body: Literals


@dataclass(frozen=True)
class Constraint:
    """`head if body`."""

    head: str
    body: Literals


@dataclass(frozen=True)
class Executability:
    """`impossible actions if body`: all of the actions together."""

    actions: tuple[str, ...]
    body: Literals


@dataclass(frozen=True)
class Sees:
    """The robot sees whether the fluent holds, in every state that satisfies the body."""

    robot: str
    fluent: str
    body: Literals


@dataclass(frozen=True)
class Shows:
    """The outcome of the action shows the fluent, if the resulting state satisfies the body."""

    action: str
    fluent: str
    body: Literals


@dataclass(frozen=True)
class Default:
    """`name: head if body`: in an initial state with the body the head usually holds.

    `exceptions` are conditions under which the default says nothing, one enough.
    """

    name: str
    head: str
    body: Literals
    exceptions: tuple[Literals, ...]


@dataclass(frozen=True)
class Trigger:
    """One way in which a scenario's exogenous action may fire.

    `upon` is the robot's action that it goes with (None: any), `drawn` the value of the drawn
    variable ("" if nothing is drawn), `pool` the literals that make this value drawable, `body`
    the literals that let the event fire, `probability` that of trying at all in a step.
    """

    scenario: str
    event: str
    upon: str | None
    drawn: str
    pool: Literals
    body: Literals
    probability: float


@dataclass(frozen=True)
class Description:
    """A ground AL_d description. Statics are evaluated away; tuples are in source order.

    `scenarios` are the names of all scenarios, also of those in which nothing happens.
    """

    name: str
    source: str
    sorts: Mapping[str, tuple[str, ...]]
    statics: frozenset[str]
    inertial: tuple[str, ...]
    defined: tuple[str, ...]
    agent_actions: tuple[str, ...]
    exogenous_actions: tuple[str, ...]
    causal: tuple[Causal, ...]
    constraints: tuple[Constraint, ...]
    executability: tuple[Executability, ...]
    sees: tuple[Sees, ...]
    shows: tuple[Shows, ...]
    costs: Mapping[str, int]
    initially: tuple[tuple[str, ...], ...]
    defaults: tuple[Default, ...]
    triggers: tuple[Trigger, ...]
    scenarios: tuple[str, ...]

    @cached_property
    def fluents(self) -> tuple[str, ...]:
        return self.inertial + self.defined

    @cached_property
    def robots(self) -> tuple[str, ...]:
        """The constants that see something, in order of declaration."""
        return tuple(dict.fromkeys(statement.robot for statement in self.sees))
