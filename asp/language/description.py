"""The ground description: everything that an AL_d text says, instance by instance."""

from collections.abc import Mapping
from functools import cached_property

from asp.language.literals import Action, Fluent, Literal
from asp.language.syntax import Node

Literals = tuple[Literal, ...]


class Causal(Node):
    """`action causes head if body`."""

    action: Action
    head: Literal
    body: Literals


class Constraint(Node):
    """`head if body`."""

    head: Literal
    body: Literals


class Executability(Node):
    """`impossible actions if body`: all of the actions together."""

    actions: tuple[Action, ...]
    body: Literals


class Sees(Node):
    """The robot sees whether the fluent holds, in every state that satisfies the body."""

    robot: str
    fluent: Fluent
    body: Literals


class Shows(Node):
    """The outcome of the action shows the fluent, if the resulting state satisfies the body."""

    action: Action
    fluent: Fluent
    body: Literals


class Default(Node):
    """`name: head if body`: in an initial state with the body the head usually holds.

    `exceptions` are conditions under which the default says nothing, one enough.
    """

    name: str
    head: Literal
    body: Literals
    exceptions: tuple[Literals, ...]


class Draw(Node):
    """A value that may be drawn; where the literals of its pool do not hold another one is."""

    value: str
    pool: Literals


class Trigger(Node):
    """One way in which a scenario's exogenous action may fire.

    `upon` is the robot's action that it goes with (None: any), `drawings` are the values of the
    drawn variables in the order in which they are drawn (none: nothing is drawn), `body` the
    literals that let the event fire, `probability` that of trying at all in a step. An agent action
    among the literals is true where it is the robot's.
    """

    scenario: str
    event: Action
    upon: Action | None
    drawings: tuple[Draw, ...]
    body: Literals
    probability: float


class Description(Node):
    """A ground AL_d description. Statics are evaluated away; tuples are in source order.

    `scenarios` are the names of all scenarios, also of those in which nothing happens.
    """

    name: str
    source: str
    sorts: Mapping[str, tuple[str, ...]]
    statics: frozenset[Literal]
    inertial: tuple[Fluent, ...]
    defined: tuple[Fluent, ...]
    agent_actions: tuple[Action, ...]
    exogenous_actions: tuple[Action, ...]
    causal: tuple[Causal, ...]
    constraints: tuple[Constraint, ...]
    executability: tuple[Executability, ...]
    sees: tuple[Sees, ...]
    shows: tuple[Shows, ...]
    costs: Mapping[str, int]
    initially: tuple[tuple[Fluent, ...], ...]
    defaults: tuple[Default, ...]
    triggers: tuple[Trigger, ...]
    scenarios: tuple[str, ...]

    @cached_property
    def fluents(self) -> tuple[Fluent, ...]:
        return self.inertial + self.defined

    @cached_property
    def robots(self) -> tuple[str, ...]:
        """The constants that see something, in order of declaration."""
        return tuple(dict.fromkeys(statement.robot for statement in self.sees))
