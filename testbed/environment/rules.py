"""The rules of a game in a world: its two agents, what a step changes, and how it ends."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from enum import StrEnum
from operator import index
from typing import Any
from typing import Literal as Choice

from asp.language import Action, Literal
from testbed.protocol import Event

ROBOT, ADVERSARY = "robot_0", "adversary_0"
ILLEGAL_REWARD = -1.0
"""Of the agent whose illegal answer ends a game, as PettingZoo's classic environments have it."""
Mode = Choice["never", "colocated", "always"]
Infos = Choice["numeric", "text"]
Illegal = Choice["error", "noop", "terminate"]
RobotReward = Choice["goal"]
AdversaryReward = Choice["zero_sum", "fail", "waste", "regret"]


class IllegalActionError(ValueError):
    """An agent's answer outside its mask; the environment's state is unchanged."""


class UnknownAgentError(ValueError):
    """The name of an agent that is not one of the environment's; one line names these."""


class ResetOptionError(ValueError):
    """What `reset` cannot take as options; one line says what is wrong with them."""


class UnknownOptionError(ResetOptionError):
    """A key of `reset(options=...)` that means nothing; one line says which is likely meant."""


class NotResetError(AssertionError):
    """Something was asked of a game before `reset`; PettingZoo's wrapper raises the same kind."""

    def __init__(self) -> None:
        super().__init__("no game has begun: reset the environment first")


@dataclass(frozen=True)
class Observability:
    """Whether the robot is told of an exogenous action: `probability` is drawn each time.

    `colocated`: only if the robot sees, before or after the step, a fluent that the action changed.
    With probability `false_reports` a step, the robot is told of one that did not happen, though it
    was possible. News, true or false, comes `delay` steps late.
    """

    mode: Mode = "never"
    probability: float = 1.0
    false_reports: float = 0.0
    delay: int = 0


@dataclass(frozen=True)
class EventRules:
    """Bounds on the adversary's events, and what an event costs it.

    `budget`: events per game; `per_object`: by sort, events per game that name one object of it;
    `cooldown`: steps that have to pass after an event; `cost`: what an event takes from the
    adversary's reward; `events`: names of exogenous actions, and ground ones, that it may use;
    `fair`: only events after which the robot can still achieve its goal. None: no bound.
    """

    budget: int | None = None
    per_object: Mapping[str, int] = field(default_factory=dict)
    cooldown: int = 0
    cost: float = 0.0
    events: tuple[str, ...] | None = None
    fair: bool = False

    def permits(self, event: Action) -> bool:
        """Whether the event is one of those that the adversary may use at all."""
        return self.events is None or event in self.events or event.name in self.events


@dataclass(frozen=True)
class Rewards:
    """What a game is worth to both agents: docs/game.md has the equations.

    `step`: what a step costs the robot; `shaping`: the factor of the potential-based reward, and
    `discount` that of the learner, which is used there.
    """

    robot: RobotReward = "goal"
    adversary: AdversaryReward = "zero_sum"
    step: float = 0.0
    shaping: float = 0.0
    discount: float = 1.0


@dataclass(frozen=True)
class Rules:
    """`steps` is the number of the last step at which the robot may answer, the first being 1.

    `observability` is by the name of the exogenous action; one left out is never observed. With
    `goal_feedback` the first of two consecutive wrong `finish` is answered instead of ending the
    game. Unless `exogenous_while_thinking`, nothing exogenous happens while the robot waits. A
    search that the rules ask for looks at `search_states` states at most.
    """

    goal: tuple[Literal, ...]
    steps: int = 100
    observability: Mapping[str, Observability] = field(default_factory=dict)
    goal_feedback: bool = True
    exogenous_while_thinking: bool = False
    adversary: EventRules = EventRules()
    rewards: Rewards = Rewards()
    search_states: int = 5_000


class Ending(StrEnum):
    """How a game ended; the values are those of a trial's `outcome`."""

    ACHIEVED = "achieved"
    FALSE_FINISH = "false_finish"
    STEP_LIMIT = "step_limit"

    @property
    def by_answer(self) -> bool:
        """Whether the robot ended the game (a termination), not the clock (a truncation)."""
        return self is not Ending.STEP_LIMIT


@dataclass(frozen=True)
class Situation:
    """Everything about a running game that changes.

    `answer` and `event` are what both agents did at the step before (None at step 1), `happened`
    whether the robot's action took effect (None if it waited or finished), `sensed` the literals
    that it showed; `told` is the news that reaches the robot now, `pending` news with the step at
    which it will; `goal_holds` is False after a `finish` that was answered, else None. `start` is
    the state at step 1, `before` that before the last step, `played` the events with their steps,
    `units` the execution units of what the robot attempted, `in_reach` whether the goal has been
    within reach at every step, True where the rewards do not ask.
    """

    trial: str
    step: int
    state: int
    goal: tuple[Literal, ...]
    answer: Action | None = None
    happened: bool | None = None
    event: Action | None = None
    sensed: tuple[Literal, ...] = ()
    told: tuple[Event, ...] = ()
    pending: tuple[tuple[int, Event], ...] = ()
    goal_holds: bool | None = None
    ending: Ending | None = None
    start: int = 0
    before: int | None = None
    played: tuple[tuple[int, Action], ...] = ()
    units: int = 0
    in_reach: bool = True


def name_of(agent: str, answer: Any, actions: Sequence[Action]) -> Action:
    """The action of an agent's answer, an index: an integer of any type, also of NumPy's.

    Raises IllegalActionError, which names the actions, also for an array of one.
    """
    try:
        number = -1 if isinstance(answer, bool) else index(answer)
    except TypeError:
        number = -1
    if 0 <= number < len(actions):
        return actions[number]
    raise IllegalActionError(f"{agent}: {answer!r} is not an action; there are {listed(actions)}")


def known_agent(agent: str) -> str:
    """The name of an agent. Raises UnknownAgentError for one that is neither agent's."""
    if agent in (ROBOT, ADVERSARY):
        return agent
    raise UnknownAgentError(f"{agent!r} is not an agent; there are {ROBOT} and {ADVERSARY}")


def listed(actions: Sequence[Action], legal: Sequence[Action] | None = None) -> str:
    """The actions, or the legal ones among them, with their indices."""
    chosen = actions if legal is None else legal
    return ", ".join(f"{i} {action}" for i, action in enumerate(actions) if action in chosen)


def rewards(ending: Ending | None) -> dict[str, float]:
    """What an ending is worth, in the zero-sum game that is played unless others are configured.

    The robot gets 1 for the goal achieved, -1 for any other end, 0 while the game goes on.
    """
    value = 0.0 if ending is None else 1.0 if ending is Ending.ACHIEVED else -1.0
    return {ROBOT: value, ADVERSARY: 0.0 - value}
