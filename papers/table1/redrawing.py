"""How much more probable a trial's event is under another way of drawing it: weights of pairs.

The robots know the state until the event, so that what they do before it does not depend on how it
is drawn. A sample of pairs, each weighted by the quotient of both probabilities of its event, is
thus one under the other way of drawing (importance sampling); nothing has to be played again.
"""

from collections.abc import Callable, Iterable, Iterator, Mapping
from functools import cache
from typing import TypeAlias

from asp.language import Action, Literal, Trigger
from testbed.experiment.record import TrialRecord
from testbed.protocol import NONE
from testbed.world import World

Chances: TypeAlias = Mapping[str, float]
Law: TypeAlias = Callable[[int, Action], Chances]
"""Of a state and the robot's action in it: the probability of each event, `none` among them."""


def as_stated(world: World, scenario: str, rate: float | None = None) -> Law:
    """What a scenario's triggers draw: a thing, then one of the events that can befall it.

    All of them draw something; `rate` is in place of their own probability.
    """
    triggers = [t for t in world.description.triggers if t.scenario == scenario]

    @cache
    def law(state: int, action: Action) -> Chances:
        drawable = [t for t in triggers if world.satisfies(state, t.drawings[0].pool)]
        groups = _grouped(t for t in drawable if t.upon in (None, action))
        shares = []
        for own in groups.values():
            possible = [t for t in own if _possible(world, state, action, t)]
            shares += [(t.event, _tried(t, rate) / len(groups) / len(possible)) for t in possible]
        return _completed(shares)

    return law


def passed_on(world: World, scenario: str, rate: float | None = None) -> Law:
    """As the released simulator draws, where the triggers are those of `as_stated`.

    A thing that is drawn while the robot has it, or is taking it, passes the draw on to the others
    of its kind. Then any event is drawn that would change something; if it is not possible, nothing
    happens at this step.
    """
    groups = _grouped(t for t in world.description.triggers if t.scenario == scenario)

    @cache
    def law(state: int, action: Action) -> Chances:
        taken = _taken(world, state, action)
        shares = []
        for kind, thing in groups:
            # Passing on to all that are free alike is the same as drawing one of them at once.
            free = [key for key in groups if key[0] == kind and key[1] not in taken]
            befallen = free or [(kind, thing)]
            for key in befallen:
                changing = [t for t in groups[key] if _changes(world, state, t.event)]
                shares += [
                    (t.event, _tried(t, rate) / len(groups) / len(befallen) / len(changing))
                    for t in changing
                    if _possible(world, state, action, t)
                ]
        return _completed(shares)

    return law


def weight(record: TrialRecord, world: World, played: Law, other: Law) -> float:
    """How many times as probable a trial's event is by another law as by the one it was played by.

    The same holds of a trial without an event.
    """
    quotient, state = 1.0, world.state(record.initial)
    event = record.exogenous[0] if record.exogenous else None
    for attempt in record.actions:
        happened = event.action if event and event.step == attempt.step else NONE
        quotient *= other(state, attempt.action).get(happened, 0.0)
        quotient /= played(state, attempt.action)[happened]
        if happened != NONE:
            break
        state = world.successor(state, [attempt.action] if attempt.happened else [])
    return quotient


def _grouped(triggers: Iterable[Trigger]) -> dict[tuple[str, str], list[Trigger]]:
    """By what is drawn: a value, for this kind of event."""
    groups: dict[tuple[str, str], list[Trigger]] = {}
    for trigger in triggers:
        groups.setdefault((trigger.event.name, trigger.drawings[0].value), []).append(trigger)
    return groups


def _tried(trigger: Trigger, rate: float | None) -> float:
    return trigger.probability if rate is None else rate


def _possible(world: World, state: int, action: Action, trigger: Trigger) -> bool:
    own = [action] if world.executable(state, [action]) else []
    applies = world.satisfies(state, (*trigger.drawings[0].pool, *trigger.body))
    return applies and world.executable(state, [*own, trigger.event])


def _changes(world: World, state: int, event: str) -> bool:
    effects = [law.head for law in world.description.causal if law.action == event]
    return not world.satisfies(state, effects)


def _taken(world: World, state: int, action: str) -> set[str]:
    """What stands in a relation to the robot, or will by a direct effect of its action."""
    causal = world.description.causal
    effects = [law.head for law in causal if law.action == action and law.head.is_positive]
    robots = set(world.description.robots)
    return set(_related([*world.true_atoms(state), *effects], robots))


def _related(atoms: Iterable[Literal], robots: set[str]) -> Iterator[str]:
    for atom in atoms:
        places = atom.arguments
        if places and places[0] in robots:
            yield from places[1:]


def _completed(shares: Iterable[tuple[str, float]]) -> Chances:
    """The probabilities of events summed up, and that of none of them."""
    chances: dict[str, float] = {}
    for event, share in shares:
        chances[event] = chances.get(event, 0.0) + share
    return {NONE: 1.0 - sum(chances.values()), **chances}
