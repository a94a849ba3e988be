"""The interface of an adversary, its view of a game, and its observation at a step."""

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, field
from typing import Literal as Choice
from typing import Protocol

from asp.language import Action, Description, Fluent, Literal
from testbed.environment import EventRules, Left
from testbed.protocol import Trace
from testbed.world import World

Sight = Choice["state", "robot_action", "trace"]
"""What a class of adversaries may declare to see, as its attribute `sees`."""
Measure = Choice["actions", "units"]
Remaining = Callable[[int, Measure], float | None]
"""The least that achieves the goal from a state of the world, in actions or execution units.

Infinite where no plan achieves it, None where the search for it was given up.
"""


Occurrence = tuple[int, Action]
"""A step, and the exogenous action that happens at it."""
Events = tuple[Occurrence, ...]
"""Exogenous actions, in the order of their steps."""


class Rehearsed(Protocol):
    """A trial that was played beforehand: its events, whether the robot finished with its goal
    achieved, and the execution units of what it attempted.
    """

    @property
    def events(self) -> Events: ...
    @property
    def achieved(self) -> bool: ...
    @property
    def units(self) -> int: ...


class Rehearsal(Protocol):
    """Plays the trial at hand beforehand, with another robot of the same name, as often as wanted.

    Trials with the same events are the same unless something is left to chance.
    """

    def episode(self, events: Events) -> Rehearsed:
        """The trial with these events."""

    def additions(self, events: Events) -> Iterator[Occurrence]:
        """Each event that is legal behind the last one of these."""

    def branches(self, events: Events, added: Sequence[Occurrence]) -> Iterator[Rehearsed]:
        """The trials with one of the `added` events behind these each, in the order of steps."""


@dataclass(frozen=True, kw_only=True)
class Game:
    """What an adversary is told of a trial before it begins.

    `goal` are the robot's literals, `exogenous_actions` the ground actions that the adversary has
    and may use, `description` the domain, at the coarse resolution, `rules` what bounds the
    adversary, and what an event costs it. `world` is the world that is played in, and `remaining`
    what its states are away from the goal, and with `rehearsal` the trial can be played
    beforehand: each is None where the adversary is not told.
    """

    scenario: str
    goal: tuple[Literal, ...]
    exogenous_actions: Sequence[Action]
    description: Description
    rules: EventRules = field(default_factory=EventRules)
    world: World | None = None
    remaining: Remaining | None = None
    rehearsal: Rehearsal | None = None


@dataclass(frozen=True)
class AdversaryView:
    """What an adversary sees before it answers.

    `state` are the true fluents, `robot_action` what the robot will attempt at this step; without
    the sight of them `state` is empty and `robot_action` None. `legal` is what may be answered:
    `none`, and the exogenous actions possible beside the robot's that the rules allow. Where these
    are many, asking whether one is legal is quick, and listing all is not. `physical`: whether the
    robot's action is one that is to change the world, and not a mental action or a test; False
    without the sight of `robot_action`. `left`: what is left of the budget and of the cooldown.
    `trace` is the mind behind that action: None without the sight of it, and where the robot tells
    nothing of its mind.
    """

    step: int
    state: frozenset[Fluent]
    robot_action: Action | None
    legal: Sequence[Action]
    physical: bool = True
    left: Left = field(default_factory=Left)
    trace: Trace | None = None


class Adversary(Protocol):
    """One adversary over many trials.

    A class that configurations name is made with a `Game` and with its options. It declares what
    it `sees`, and as `Options`, if it has any, a dataclass with a field per key of
    `adversary.options`.
    """

    @property
    def sees(self) -> Sequence[Sight]:
        """What `AdversaryView` is to hold beside the step and what is legal."""

    def reset(self, seed: int) -> None:
        """Begins a trial; everything drawn in it follows from the seed."""

    def act(self, view: AdversaryView) -> Action:
        """The answer at a step: `none` or a ground exogenous action that is legal."""
