"""Small coarse domains with their games, which share no word with those of the package."""

from pathlib import Path

from hypothesis import assume

from asp import SourceError, parse_description
from testbed.world import World, world_of
from tests.greenhouse import GREENHOUSE
from tests.world.test_world_random import HEADER

FERRY = """\
sorts
  robot = {skipper}.
  bank  = {east, west, island}.
  load  = {goat, cabbage}.
  rider = robot + load.
fluents
  inertial moored(rider, bank).
  inertial aboard(robot, load).
  inertial foggy.
actions
  agent     sail(robot, bank).
  agent     take(robot, load).
  agent     drop(robot, load).
  exogenous drift(load, bank).
  exogenous fog.
laws
  sail(R, B)  causes moored(R, B).
  take(R, L)  causes aboard(R, L).
  drop(R, L)  causes -aboard(R, L).
  drift(L, B) causes moored(L, B).
  fog         causes foggy.
  -moored(X, B2) if moored(X, B1), B1 != B2.
  moored(L, B)   if moored(R, B), aboard(R, L), robot(R).
  impossible sail(R, B) if moored(R, B).
  impossible sail(R, island) if foggy.
  impossible take(R, L) if aboard(R, L2).
  impossible take(R, L) if moored(R, B1), moored(L, B2), B1 != B2.
  impossible drop(R, L) if -aboard(R, L).
  impossible drift(L, B) if aboard(R, L).
  impossible drift(L, B) if moored(L, B).
  impossible fog if foggy.
initially
  moored(X, B) for some B.
sees
  R sees moored(R, B) if robot(R).
  R sees aboard(R, L) if robot(R).
  R sees moored(L, B) if moored(R, B).
"""
"""A skipper sees the bank where the boat is; fog, which nobody sees, closes the island."""

COINS = """\
sorts
  robot = {clerk}.
fluents
  inertial heads.
  inertial tails.
  inertial tossed.
actions
  agent     toss.
  agent     turn.
  exogenous shake.
laws
  toss causes tossed.
  -heads if tossed, tails.
  -tails if tossed, heads.
  turn causes heads.
  shake causes tossed.
sees
  R sees heads if robot(R).
"""
"""A toss has several outcomes."""

DOMAINS = {
    "pots": (GREENHOUSE, ["stands(fern,sill)", "stands(rose,floor)"]),
    "ferry": (FERRY, ["moored(goat,island)", "-aboard(skipper,goat)"]),
    "coins": (COINS, ["heads"]),
}
"""By name the text of a domain, and a goal."""


def write_domain(folder: Path, name: str) -> Path:
    """A configuration with one of these domains, in a folder."""
    text, goal = DOMAINS[name]
    (folder / f"{name}.al").write_text(text, encoding="utf-8")
    config = folder / f"{name}.yaml"
    config.write_text(f"name: {name}\ndomain: {name}.al\ngoal: {goal!r}\n", encoding="utf-8")
    return config


def random_world(drawn: list[str]) -> World:
    """The world of a robot in a description with these laws, if games can be played in it."""
    text = HEADER.replace("thing = {it}", "robot = {it}").replace("h(thing)", "h(robot)")
    text += "\n".join(f"  {law}" for law in drawn) + "\n"
    text += "sees\n  R sees f if robot(R).\n  R sees g if h(R).\n"
    try:
        world = world_of(parse_description(text))
    except SourceError:  # a fluent defined through its own negation
        assume(False)
    states = tuple(world.states())
    assume(states and all(world.successors(state, ()) for state in states))
    return world
