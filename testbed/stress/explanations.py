"""The fewest events that explain what a robot heeded, by brute force over states of the world.

The reference for (27) in worlds that are small enough: at each step every state that the world
may be in is kept, with the fewest unobserved events that lead there. At most one is assumed per
step, and literals that the robot did not heed though they agree with its belief count as heeded,
so that a smaller number found here is an explanation in any case.
"""

from collections.abc import Iterator, Mapping

from asp.language import Action, Literal
from testbed.experiment.episodes import Episode
from testbed.experiment.storyteller import Moment
from testbed.protocol import FINISH, WAIT

MOST_STATES = 20_000

Reached = dict[int, int]
"""States, each with the fewest unobserved events that lead to it."""


def fewest_events(episode: Episode) -> Iterator[tuple[int, int, int]]:
    """Of each explanation that is adopted: its step, its events, and the fewest that suffice.

    Nothing is said where the initial state is not known, reports or tests may be wrong, an
    explanation is not proved to be minimal, and beyond `MOST_STATES` states.
    """
    setting = episode.spec.setting
    false_reports = any(own.false_reports > 0 for own in setting.observability.values())
    if setting.knowledge != "complete" or false_reports:
        return
    told, assumed = _told(episode), _assumed(episode)
    reached: Reached = {next(episode.states): 0}
    for number, moment in enumerate(episode.moments[: max(assumed, default=-1) + 1]):
        if number:
            reached = _after(episode, reached, episode.moments[number - 1], moment, told)
        reached = _seen(episode, reached, moment)
        # Only what has fewer events than an explanation to come can show that it is not minimal.
        most = max(events for at, events in assumed.items() if at >= number)
        reached = {state: events for state, events in reached.items() if events < most}
        if len(reached) > MOST_STATES:
            return
        if number in assumed:
            enough = min(reached.values(), default=assumed[number])
            yield moment.percept.step, assumed[number], enough


def _assumed(episode: Episode) -> dict[int, int]:
    """By the position of its moment, the events of each explanation that is adopted as minimal."""
    found = {}
    for number, moment in enumerate(episode.moments):
        adopted = moment.decision.trace.explanation
        if adopted is not None and adopted.minimal == "proved" and not adopted.distrusted:
            found[number] = len(adopted.unobserved)
    return found


def _told(episode: Episode) -> Mapping[int, frozenset[Action]]:
    """The events that the robot is told of sooner or later, by the step at which they happened."""
    found: dict[int, set[Action]] = {}
    for moment in episode.moments:
        for event in moment.percept.events:
            found.setdefault(event.step, set()).add(event.action)
    return {step: frozenset(events) for step, events in found.items()}


def _after(
    episode: Episode,
    reached: Reached,
    before: Moment,
    moment: Moment,
    told: Mapping[int, frozenset[Action]],
) -> Reached:
    """What a step leads to with at most one unobserved event, if the attempt comes out as told."""
    world, attempted = episode.setup.world, before.decision.action
    physical = attempted not in (WAIT, FINISH)
    happened = bool(moment.percept.happened)
    observed = tuple(sorted(told.get(before.percept.step, ())))
    compound = (*((attempted,) if physical and happened else ()), *observed)
    goal = episode.spec.setting.goal
    found: Reached = {}
    for state, events in reached.items():
        if moment.percept.goal_holds is False and world.satisfies(state, goal):
            continue
        if physical and bool(world.successors(state, (attempted,))) != happened:
            continue
        for own in ((), *((event,) for event in world.exogenous_actions if event not in observed)):
            for after in world.successors(state, (*compound, *own)):
                number = events + len(own)
                found[after] = min(number, found.get(after, number))
    return found


def _seen(episode: Episode, reached: Reached, moment: Moment) -> Reached:
    """The states that agree with all that the robot sees and does not leave unheeded."""
    unheeded = moment.decision.trace.unheeded or ()
    heeded: list[Literal] = [own for own in moment.percept.visible if own not in unheeded]
    world = episode.setup.world
    return {state: n for state, n in reached.items() if world.satisfies(state, heeded)}
