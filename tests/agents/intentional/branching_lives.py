"""Lives in worlds whose actions have several outcomes, drawn with a seed."""

from collections.abc import Collection, Sequence
from dataclasses import dataclass, field
from random import Random

from asp.language import Description, Literal
from testbed.protocol import FINISH, WAIT, Decision, Event, Percept, Plans, Robot, Task
from testbed.world import World, world_of


@dataclass
class Life:
    """What a robot decided, and the states of the world: `states[i]` is that of step i."""

    states: list[int]
    decisions: list[Decision] = field(default_factory=list)
    events: list[Event] = field(default_factory=list)

    @property
    def actions(self) -> list[str]:
        """The physical actions that were attempted."""
        return [d.action for d in self.decisions if d.action not in (WAIT, FINISH)]


def task_of(
    description: Description,
    initial: Sequence[Literal],
    goal: Sequence[str],
    plans: Plans = "optimistic",
    plan_limit: int = 4,
) -> Task:
    """The task of a robot that knows these literals at first."""
    return Task(
        trial="life",
        robot="intentional",
        domain="branching",
        source=description.source,
        goal=[*map(Literal.parse, goal)],
        initial=list(initial),
        plan_limit=plan_limit,
        seed=0,
        plans=plans,
    )


def live(
    robot: Robot,
    description: Description,
    initial: int,
    goal: Sequence[str],
    *,
    plans: Plans = "optimistic",
    seen: Collection[str] | None = None,
    known: Collection[str] | None = None,
    events: bool = False,
    seed: int = 0,
    steps: int = 16,
) -> Life:
    """A life of at most so many steps, in which the robot sees these fluents, or all.

    At first it knows of those that are `known`, or all.

    With `events`, exogenous actions happen at a third of the steps with physical actions. Who
    finishes without the goal is told of it, once in a row.
    """
    world, random, life = world_of(description), Random(seed), Life([initial, initial])
    told = _visible(world, initial, known)
    robot.begin(task_of(description, told, goal, plans))
    percept = Percept(trial="life", step=1, visible=_visible(world, initial, seen))
    for step in range(1, steps + 1):
        decision, state = robot.act(percept), life.states[-1]
        life.decisions.append(decision)
        action, wanted = decision.action, [*map(Literal.parse, goal)]
        achieved = world.satisfies(state, wanted)
        if action == FINISH and (achieved or percept.goal_holds is False):
            break
        physical = () if action in (WAIT, FINISH) else (action,)
        done = physical if world.executable(state, physical) else ()
        others = [e for e in world.exogenous_actions if world.executable(state, (*done, e))]
        if events and physical and others and random.random() < 1 / 3:
            done = (*done, random.choice(others))
            life.events.append(Event(step=step, action=done[-1]))
        life.states.append(random.choice(world.successors(state, done)))
        percept = Percept(
            trial="life",
            step=step + 1,
            visible=_visible(world, life.states[-1], seen),
            attempted=action if physical else None,
            happened=physical[0] in done if physical else None,
            goal_holds=False if action == FINISH else None,
        )
    return life


def _visible(world: World, state: int, seen: Collection[str] | None) -> list[Literal]:
    return [each for each in world.literals(state) if seen is None or each.atom in seen]
