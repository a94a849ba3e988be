"""Trials played in the bare world, with an adversary that follows a script of wishes."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from asp.loading import load_description, read_domain
from testbed.environment.world import World
from testbed.link.messages import Decision, Event, Percept, Task
from testbed.link.robot import Robot

DOMAIN = "office"
WORLD = World(load_description(DOMAIN))
SOURCE = read_domain(DOMAIN)[1]
ROBOT = WORLD.description.robots[0]
BOTH_IN_THE_LIBRARY = (
    "loc(book1,library)",
    "loc(book2,library)",
    "-in_hand(rob1,book1)",
    "-in_hand(rob1,book2)",
)


@dataclass(frozen=True)
class Wish:
    """An exogenous action by its number among the possible ones, and whether it is reported.

    One that does not happen makes the report false. A report comes `late` steps late.
    """

    number: int
    reported: bool = False
    happens: bool = True
    late: int = 0


@dataclass(frozen=True)
class Life:
    """How a trial went: the decisions, whether the goal holds in the end, states from step 1."""

    decisions: Sequence[Decision]
    achieved: bool
    states: Sequence[int]

    @property
    def finished(self) -> bool:
        """Whether the robot ended it, rather than the limit of steps."""
        return self.decisions[-1].action == "finish"


def live(
    robot: Robot,
    initial: int,
    goal: Sequence[str] = BOTH_IN_THE_LIBRARY,
    wishes: Mapping[int, Wish] | None = None,
    steps: int = 40,
    feedback: bool = True,
) -> Life:
    """Plays a trial in the state `initial`, with or without goal feedback, for so many steps."""
    states = [initial]
    state, decisions, news = initial, list[Decision](), list[tuple[int, Event]]()
    robot.begin(_task(initial, goal))
    percept = _percept(state, 1)
    while percept.step < steps:
        decision = robot.act(percept)
        decisions.append(decision)
        if decision.action == "finish":
            done = WORLD.satisfies(state, goal)
            if done or not feedback or [d.action for d in decisions[-2:]] == ["finish", "finish"]:
                return Life(decisions, done, states)
            percept = _percept(state, percept.step + 1, _due(news, percept.step), goal_holds=False)
            states.append(state)
            continue
        attempt = None if decision.action == "wait" else decision.action
        wish = (wishes or {}).get(percept.step)
        state, percept = _advance(state, percept.step, attempt, wish, news)
        states.append(state)
    return Life(decisions, WORLD.satisfies(state, goal), states)


def _advance(
    state: int, step: int, attempt: str | None, wish: Wish | None, news: list[tuple[int, Event]]
) -> tuple[int, Percept]:
    happened = None if attempt is None else WORLD.executable(state, [attempt])
    actions = {attempt} if attempt is not None and happened else set[str]()
    possible = [
        event
        for event in WORLD.exogenous_actions
        if wish is not None and WORLD.executable(state, actions | {event})
    ]
    events = [possible[wish.number % len(possible)]] if wish is not None and possible else []
    if wish is not None and wish.reported:
        news += ((step + wish.late, Event(step=step, action=event)) for event in events)
    if wish is not None and not wish.happens:
        events = []
    after = WORLD.successor(state, actions.union(events))
    return after, _percept(after, step + 1, _due(news, step), attempt, happened)


def _due(news: list[tuple[int, Event]], step: int) -> list[Event]:
    """The news that comes after this step."""
    return [event for due, event in news if due == step]


def _percept(
    state: int,
    step: int,
    events: Sequence[Event] = (),
    attempted: str | None = None,
    happened: bool | None = None,
    goal_holds: bool | None = None,
) -> Percept:
    return Percept(
        trial="life",
        step=step,
        visible=list(WORLD.visible(state, ROBOT)),
        attempted=attempted,
        happened=happened,
        events=list(events),
        goal_holds=goal_holds,
    )


def _task(initial: int, goal: Sequence[str]) -> Task:
    return Task(
        trial="life",
        robot="intentional",
        domain=DOMAIN,
        source=SOURCE,
        goal=list(goal),
        initial=list(WORLD.literals(initial)),
        plan_limit=20,
        seed=0,
    )
