"""Trials played in the bare world, with an adversary that follows a script of wishes."""

from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

from msgspec import structs

from asp.language import load_description, read_domain
from testbed.protocol import Decision, Event, Percept, Relevance, Robot, Task
from testbed.world import World, world_of
from tests.literals import parsed


@dataclass(frozen=True)
class Place:
    """A domain; in a `dark` one the robot starts knowing only what it sees."""

    domain: str
    world: World
    source: str
    dark: bool = False

    @property
    def robot(self) -> str:
        return self.world.description.robots[0]

    def known(self, initial: int) -> tuple[str, ...]:
        """What the robot is told of the initial state."""
        return (
            self.world.visible(initial, self.robot) if self.dark else self.world.literals(initial)
        )


def place(domain: str, dark: bool = False) -> Place:
    file, source = read_domain(domain)
    return Place(Path(file).stem, world_of(load_description(domain)), source, dark)


OFFICE = place("office")
DOMAIN, WORLD, SOURCE = OFFICE.domain, OFFICE.world, OFFICE.source
STATES = list(WORLD.initial_states())
GOAL_LITERALS = [
    literal
    for fluent in WORLD.fluents
    if not fluent.startswith("locked")
    for literal in (fluent, fluent.complement)
]
BOTH_IN_THE_LIBRARY = parsed(
    ["loc(book1,library)", "loc(book2,library)", "-in_hand(rob1,book1)", "-in_hand(rob1,book2)"]
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
    where: Place = OFFICE,
    failing: Collection[int] = (),
    relevance: Relevance = "definition",
) -> Life:
    """Plays a trial in the state `initial`, with or without goal feedback, for so many steps.

    At the steps in `failing` the execution of an attempt fails, whether it is possible or not.
    """
    goal, states = parsed(goal), [initial]
    state, decisions, news = initial, list[Decision](), list[tuple[int, Event]]()
    robot.begin(structs.replace(_task(initial, goal, where), relevance=relevance))
    percept = _percept(where, state, 1)
    while percept.step < steps:
        decision = robot.act(percept)
        decisions.append(decision)
        if decision.action == "finish":
            done = where.world.satisfies(state, goal)
            if done or not feedback or [d.action for d in decisions[-2:]] == ["finish", "finish"]:
                return Life(decisions, done, states)
            percept = _percept(
                where, state, percept.step + 1, _due(news, percept.step), goal_holds=False
            )
            states.append(state)
            continue
        attempt = None if decision.action == "wait" else decision.action
        wish = (wishes or {}).get(percept.step)
        fails = percept.step in failing
        state, percept = _advance(where, state, percept.step, attempt, wish, news, fails)
        states.append(state)
    return Life(decisions, where.world.satisfies(state, goal), states)


def _advance(
    where: Place,
    state: int,
    step: int,
    attempt: str | None,
    wish: Wish | None,
    news: list[tuple[int, Event]],
    fails: bool,
) -> tuple[int, Percept]:
    world = where.world
    happened = None if attempt is None else not fails and world.executable(state, [attempt])
    actions = {attempt} if attempt is not None and happened else set[str]()
    possible = [
        event
        for event in world.exogenous_actions
        if wish is not None and world.executable(state, actions | {event})
    ]
    events = [possible[wish.number % len(possible)]] if wish is not None and possible else []
    if wish is not None and wish.reported:
        news += ((step + wish.late, Event(step=step, action=event)) for event in events)
    if wish is not None and not wish.happens:
        events = []
    after = world.successor(state, actions.union(events))
    percept = _percept(where, after, step + 1, _due(news, step), attempt, happened)
    return after, structs.replace(percept, failing=fails and attempt is not None)


def _due(news: list[tuple[int, Event]], step: int) -> list[Event]:
    """The news that comes after this step."""
    return [event for due, event in news if due == step]


def _percept(
    where: Place,
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
        visible=list(where.world.visible(state, where.robot)),
        attempted=attempted,
        happened=happened,
        events=list(events),
        goal_holds=goal_holds,
    )


def _task(initial: int, goal: Sequence[str], where: Place) -> Task:
    return Task(
        trial="life",
        robot="intentional",
        domain=where.domain,
        source=where.source,
        goal=list(goal),
        initial=list(where.known(initial)),
        plan_limit=20,
        seed=0,
    )
