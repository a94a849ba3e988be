"""Which visible fluents of an office a robot heeds, by the configuration's `relevance`, by hand.

Where the robot is itself it always knows, whether or not that is relevant: nobody else moves it. So
what a checking robot heeds beside the others, where it would have to look from, is left out.
"""

from collections.abc import Callable, Collection, Iterable, Mapping
from dataclasses import dataclass

from benchmarks.games.literals import ROBOT, ROOMS, SECURE, Plan, atom, parts
from benchmarks.games.office import Office, State

Fluents = set[str]


@dataclass(frozen=True)
class Scene:
    """What the robot had in mind when it came to see something.

    `believed` is the state that it believed in (None: it knew too little), `attempt` what it just
    attempted, `ahead` the actions of its activity that are left.
    """

    office: Office
    goal: Collection[str]
    believed: State | None
    attempt: str | None
    ahead: Plan


def shown(attempt: str | None, visible: Collection[str]) -> Fluents:
    """The fluents that an action's outcome shows (spec 1), if they are visible."""
    if attempt is None:
        return set()
    name, (*_, last) = parts(attempt)
    if name == "move":
        rooms = {f"loc({ROBOT},{room})" for room in ROOMS}
        if f"loc({ROBOT},{last})" in visible:
            return rooms
        doors = last, *(room for room in ROOMS if f"loc({ROBOT},{room})" in visible)
        return rooms | {f"locked({room})" for room in doors if room == SECURE}
    if name == "unlock":
        return {f"locked({last})"}
    return {f"in_hand({ROBOT},{last})", *_places(last)}


def _published(scene: Scene) -> Fluents:
    """The fluents of the goal, and those that decide one of them through a single constraint."""
    found = set(map(atom, scene.goal))
    for fluent in map(atom, scene.goal):
        name, arguments = parts(fluent)
        if name == "loc":
            found |= _places(arguments[0])
            if arguments[0] != ROBOT:
                found |= {f"loc({ROBOT},{arguments[1]})", f"in_hand({ROBOT},{arguments[0]})"}
        if name == "in_hand":
            found |= _hand(scene.office)
    return found


def _definition(scene: Scene) -> Fluents:
    """What is about relCon(T, G), and what may change the goal through constraints."""
    constants, found = _relevant(scene), _bearing(scene.office, map(atom, scene.goal))
    for fluent in scene.office.atoms:
        if parts(fluent)[1][0] in constants:  # what follows is the value of a function
            found.add(fluent)
    return found


def _plan(scene: Scene) -> Fluents:
    """The same, and what makes the actions that are left possible."""
    conditions = (each for action in scene.ahead for each in _conditions(scene.office, action))
    return _definition(scene) | _bearing(scene.office, conditions)


def _all(scene: Scene) -> Fluents:
    return set(scene.office.atoms)


RELEVANT: Mapping[str, Callable[[Scene], Fluents]] = {
    "published": _published,
    "definition": _definition,
    "plan": _plan,
    "all": _all,
}
"""The fluents that are relevant to the goal, or to the action at hand."""


def _relevant(scene: Scene) -> set[str]:
    """relCon(T, G) of Definition 1 (P 3.3), where T is the transition by the action at hand."""
    office, state = scene.office, scene.believed
    action = scene.attempt or next(iter(scene.ahead), None)
    found = _constants(scene.goal)
    if action is None or state is None:
        return found
    after = office.after(state, frozenset([action])) or state
    found |= _constants([action, *(office.fluents(state) ^ office.fluents(after))])
    name, (*_, last) = parts(action)
    if name != "put_down":
        found.add(state.robot)
    if name == "move" and state.locked:
        found.add(SECURE)
    if name == "pickup":
        found.add(office.place(state, last))
        found |= {state.held} if state.held is not None else set()
    return found


def _conditions(office: Office, action: str) -> Fluents:
    """The fluents in executability conditions of an action."""
    name, (*_, last) = parts(action)
    if name == "put_down":
        return {f"in_hand({ROBOT},{last})"}
    if name == "pickup":
        return _hand(office) | _places(ROBOT) | _places(last)
    return _places(ROBOT) | {f"locked({SECURE})"}


def _bearing(office: Office, fluents: Iterable[str]) -> Fluents:
    """The fluents, and those from which their values follow by state constraints, step by step."""
    found = set(fluents)
    for name, arguments in map(parts, tuple(found)):
        if name == "loc":
            found |= _places(arguments[0]) | _places(ROBOT)
        if name == "in_hand" or (name == "loc" and arguments[0] != ROBOT):
            found |= _hand(office)
    return found


def _constants(literals: Iterable[str]) -> set[str]:
    return {constant for each in literals for constant in parts(atom(each))[1]}


def _places(thing: str) -> Fluents:
    return {f"loc({thing},{room})" for room in ROOMS}


def _hand(office: Office) -> Fluents:
    return {f"in_hand({ROBOT},{book})" for book in office.books}
