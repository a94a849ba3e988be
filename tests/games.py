"""Small domains with dead ends, and what can be said of them by brute force.

They share no word with the packaged ones. In the harbour actions cost units, in the pottery some
have several outcomes, and in all of them others can put a goal out of reach.
"""

import json
from collections.abc import Iterable, Mapping, Sequence
from math import inf
from pathlib import Path
from typing import Any, NamedTuple

from testbed.world import World

HARBOUR = """
sorts
  berth = {east, west, dock}.
  pilot = {mate}.
  crate = {silk, salt}.
fluents
  inertial lies(crate, berth).
  inertial stands(pilot, berth).
  inertial silted(berth).
actions
  agent     sail(pilot, berth).
  agent     ship(pilot, crate, berth).
  exogenous drift(crate, berth).
  exogenous silt(berth).
laws
  sail(P, B)    causes stands(P, B).
  ship(P, C, B) causes stands(P, B).
  ship(P, C, B) causes lies(C, B).
  drift(C, B)   causes lies(C, B).
  silt(B)       causes silted(B).
  -stands(P, A) if stands(P, B), A != B.
  -lies(C, A) if lies(C, B), A != B.
  impossible sail(P, B)    if stands(P, B).
  impossible sail(P, B)    if silted(B).
  impossible ship(P, C, B) if silted(B).
  impossible ship(P, C, B) if lies(C, B).
  impossible ship(P, C, B) if stands(P, A), -lies(C, A).
  impossible drift(C, B)   if lies(C, B).
  impossible silt(B)       if silted(B).
initially
  lies(C, B) for some B.
  stands(P, B) for some B.
sees
  P sees stands(P, B).
  P sees lies(C, B) if stands(P, B).
costs
  sail(P, B)    costs 3.
  ship(P, C, B) costs 5.
"""

LANTERNS = """
sorts
  lantern = {red, green, blue}.
  keeper  = {ada}.
fluents
  inertial glows(lantern).
  inertial cracked(lantern).
actions
  agent     kindle(keeper, lantern).
  agent     douse(keeper, lantern).
  exogenous crack(lantern).
  exogenous gust(lantern).
laws
  kindle(K, L) causes glows(L).
  douse(K, L)  causes -glows(L).
  gust(L)      causes -glows(L).
  crack(L)     causes cracked(L).
  -glows(L) if cracked(L).
  impossible kindle(K, L) if glows(L).
  impossible kindle(K, L) if cracked(L).
  impossible douse(K, L)  if -glows(L).
  impossible gust(L)      if -glows(L).
  impossible crack(L)     if cracked(L).
sees
  K sees glows(L) if keeper(K).
"""

POTTERY = """
sorts
  piece  = {bowl, vase}.
  potter = {ida}.
fluents
  inertial soft(piece).
  inertial firm(piece).
  inertial hot(piece).
  inertial broken(piece).
actions
  agent     knead(potter, piece).
  agent     fire(potter, piece).
  exogenous chill(piece).
  exogenous smash(piece).
laws
  knead(P, X) causes soft(X).
  knead(P, X) causes firm(X).
  knead(P, X) causes -hot(X).
  fire(P, X)  causes hot(X).
  chill(X)    causes -hot(X).
  smash(X)    causes broken(X).
  -soft(X) if firm(X), hot(X).
  -firm(X) if soft(X), hot(X).
  impossible knead(P, X) if broken(X).
  impossible knead(P, X) if soft(X), firm(X).
  impossible fire(P, X)  if hot(X).
  impossible chill(X)    if -hot(X).
  impossible smash(X)    if broken(X).
sees
  P sees hot(X) if potter(P).
"""


class Domain(NamedTuple):
    """A domain, a goal in it, a state to begin in, and events per game that may name an object."""

    text: str
    goal: Sequence[str]
    initial: Sequence[str]
    per_object: Mapping[str, int]


DOMAINS = {
    "harbour": Domain(
        HARBOUR,
        ["lies(silk,west)", "lies(salt,west)"],
        ["lies(silk,east)", "lies(salt,dock)", "stands(mate,dock)"],
        {"crate": 2, "berth": 1},
    ),
    "lanterns": Domain(LANTERNS, ["glows(red)", "glows(blue)"], ["glows(green)"], {"lantern": 1}),
    "pottery": Domain(
        POTTERY,
        ["firm(bowl)", "hot(bowl)", "firm(vase)"],
        ["soft(bowl)", "soft(vase)"],
        {"piece": 1},
    ),
}


def config_of(folder: Path, name: str, **keys: Any) -> Path:
    """A configuration of one of the domains, with further keys."""
    own = DOMAINS[name]
    (folder / f"{name}.al").write_text(own.text, encoding="utf-8")
    given = {"goal": list(own.goal), "initial": list(own.initial), "limits": {"steps": 40}}
    text = json.dumps({"name": name, "domain": f"{name}.al", **given, **keys})
    (folder / f"{name}.yaml").write_text(text, encoding="utf-8")
    return folder / f"{name}.yaml"


def reaches(world: World, state: int, goal: Iterable[str]) -> bool:
    """Whether some actions of the robot lead from the state to one of the goal."""
    wanted, seen, todo = tuple(goal), {state}, [state]
    while todo:
        current = todo.pop()
        if world.satisfies(current, wanted):
            return True
        after = {s for action in world.agent_actions for s in world.successors(current, [action])}
        todo += after - seen
        seen |= after
    return False


def least_costs(world: World, goal: Iterable[str], costs: Mapping[str, int]) -> dict[int, float]:
    """Of every state what it costs to get to the goal."""
    wanted, states = tuple(goal), [*world.states()]
    least = {s: 0.0 if world.satisfies(s, wanted) else inf for s in states}
    while True:
        better = {
            state: cost
            for state in states
            for cost in [
                min(
                    (
                        costs[action] + least[after]
                        for action in world.agent_actions
                        for after in world.successors(state, [action])
                    ),
                    default=inf,
                )
            ]
            if cost < least[state]
        }
        if not better:
            return least
        least |= better


def least_knowing(
    world: World,
    start: int,
    goal: Iterable[str],
    costs: Mapping[str, int],
    events: Mapping[int, str],
) -> float:
    """What it costs who knows the events: each way through all steps, and then undisturbed."""
    wanted, after_all = tuple(goal), least_costs(world, goal, costs)
    layer, best = {start: 0.0}, inf
    for step in range(1, max(events, default=0) + 1):
        best = min([best, *(cost for s, cost in layer.items() if world.satisfies(s, wanted))])
        event, following = events.get(step), {}
        for state, spent in layer.items():
            for action in (None, *world.agent_actions):
                alone = [] if action is None else [action]
                if not world.successors(state, alone):
                    continue
                both = world.successors(state, [*alone, event]) if event else ()
                cost = spent + (costs[action] if action else 0)
                for after in both or world.successors(state, alone):
                    following[after] = min(cost, following.get(after, inf))
        layer = following
    return min([best, *(cost + after_all[state] for state, cost in layer.items())])
