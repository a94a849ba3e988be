"""Histories of a robot that wanders about aimlessly, while others do as they please."""

from collections.abc import Iterator
from dataclasses import dataclass
from random import Random

from asp.language import Action, Fluent, Literal
from asp.reasoning.diagnosis import GOAL, SELECT, History
from testbed.world import World
from tests.agents.intentional.lives import Place

Report = tuple[int, Action]


@dataclass(frozen=True)
class Habits:
    """How likely things are at each step, and how many steps late a report may come.

    `fails`: an attempt is not executed, or said to have failed in execution though it was
    impossible. `doubts`: one observation rests on a test, which is taken for wrong at once, as it
    is, or so many steps late, though it is right; no history is inconsistent.
    """

    event: float = 0.1
    reported: float = 0.5
    false_report: float = 0.05
    late: int = 3
    looks: float = 0.7
    waits: float = 0.3
    told: float = 0.1
    fails: float = 0.0
    doubts: float = 0.0


def wander(
    where: Place, goal: tuple[Literal, ...], steps: int, seed: int, habits: Habits
) -> Iterator[History]:
    """The history at each step, one that grows. The robot knows what it is told of the start."""
    draw, world = Random(seed), where.world
    state = draw.choice(list(world.initial_states()))
    history, news = History(), list[tuple[int, Report]]()
    tests = list[tuple[int, tuple[int, Fluent]]]()
    history.observe(where.known(state), 0)
    history.happened(SELECT, True, 0)
    for step in range(steps):
        attempt = _attempt(world, state, draw, habits) if step else None
        actions = _recorded(history, world, state, attempt, draw, habits)
        events = _events(world, state, actions, draw, habits) if step else ()
        news += _news(world, events, step, draw, habits)
        state = world.successor(state, (*actions, *events))
        for due, (time, event) in list(news):
            if due <= step:
                news.remove((due, (time, event)))
                history.happened(event, True, time)
        history.step = step + 1
        if draw.random() < habits.looks:
            visible = world.visible(state, where.robot)
            history.observe(visible, history.step)
            if visible and _befalls(draw, habits.doubts):
                tests.append(_test(history, draw.choice(visible), draw, habits))
        history.distrust(test for due, test in tests if due <= history.step)
        if draw.random() < habits.told:
            history.observe(
                [GOAL if world.satisfies(state, goal) else GOAL.complement], history.step
            )
        yield history


def _attempt(world: World, state: int, draw: Random, habits: Habits) -> Action | None:
    if draw.random() < habits.waits:
        return None
    actions = list(world.description.agent_actions)
    possible = [action for action in actions if world.executable(state, [action])]
    return draw.choice(possible if possible and draw.random() < 0.8 else actions)


def _recorded(
    history: History, world: World, state: int, attempt: Action | None, draw: Random, habits: Habits
) -> tuple[Action, ...]:
    """The attempt if it takes effect; it is recorded with its result."""
    if attempt is None:
        return ()
    failing = _befalls(draw, habits.fails)
    success = world.executable(state, [attempt]) and not failing
    history.attempt(attempt, history.step)
    history.happened(attempt, success, history.step)
    if failing:
        history.failed(attempt, history.step)
    return (attempt,) if success else ()


def _test(
    history: History, literal: Literal, draw: Random, habits: Habits
) -> tuple[int, tuple[int, Fluent]]:
    """When an observation will be taken for wrong, and which."""
    step, late = history.step, draw.randint(0, habits.late)
    history.doubt([literal], step)
    if not late:
        history.observe([literal.complement], step)
    return step + late, (step, literal.atom)


def _befalls(draw: Random, chance: float) -> bool:
    return chance > 0 and draw.random() < chance


def _events(
    world: World, state: int, actions: tuple[Action, ...], draw: Random, habits: Habits
) -> tuple[Action, ...]:
    if draw.random() >= habits.event:
        return ()
    possible = [e for e in world.exogenous_actions if world.executable(state, {*actions, e})]
    return (draw.choice(possible),) if possible else ()


def _news(
    world: World, events: tuple[Action, ...], step: int, draw: Random, habits: Habits
) -> Iterator[tuple[int, Report]]:
    for event in events:
        if draw.random() < habits.reported:
            yield step + draw.randint(0, habits.late), (step, event)
    if step and draw.random() < habits.false_report:
        event = draw.choice(list(world.exogenous_actions))
        yield step + draw.randint(0, habits.late), (step, event)
