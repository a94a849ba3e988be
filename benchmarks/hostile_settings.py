"""Where hostile lives are lived: domains with goals to draw, and what robots are told there."""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from random import Random
from typing import Any

from asp.language import Literal
from benchmarks.offices import book_names, office, room_names
from benchmarks.problems import delivered
from testbed.config import ExperimentConfig
from testbed.experiment.plan import plan_trials
from testbed.experiment.specs import TrialSpec
from testbed.protocol import Knowledge
from testbed.world import load_world

COAST = """
% A keeper lights the beacons of three capes in a row; the wind blows them out.
sorts
  cape   = {ness, head, spit}.
  beacon = {beacon1, beacon2, beacon3, beacon4, beacon5, beacon6, beacon7, beacon8, beacon9}.
  keeper = {ada}.
statics
  path(cape, cape).
  stands(beacon, cape).
fluents
  inertial at(keeper, cape).
  inertial burning(beacon).
actions
  agent     walk(keeper, cape).
  agent     kindle(keeper, beacon).
  exogenous blow_out(beacon).
laws
  walk(K, C)   causes at(K, C).
  kindle(K, B) causes burning(B).
  blow_out(B)  causes -burning(B).
  path(C, D) if path(D, C).
  -at(K, C)  if at(K, D), C != D.
  impossible walk(K, C)   if at(K, C).
  impossible walk(K, C)   if at(K, D), -path(D, C).
  impossible kindle(K, B) if burning(B).
  impossible kindle(K, B) if at(K, C), -stands(B, C).
  impossible blow_out(B)  if -burning(B).
facts
  path(ness, head).
  path(head, spit).
  stands(beacon1, ness).
  stands(beacon2, ness).
  stands(beacon3, ness).
  stands(beacon4, head).
  stands(beacon5, head).
  stands(beacon6, head).
  stands(beacon7, spit).
  stands(beacon8, spit).
  stands(beacon9, spit).
initially
  at(K, C) for some C.
sees
  K sees at(K, C)   if keeper(K).
  K sees burning(B) if at(K, C), stands(B, C).
  K sees burning(B) if at(K, C), stands(B, D), path(C, D).
"""
"""Nine events that do not depend on each other; from the ends of the row three are not seen."""


@dataclass(frozen=True)
class Setting:
    """An AL_d text, and how the goal of a game in it is drawn."""

    text: str
    goal: Callable[[Random], Sequence[Literal]]


def _office(books: int) -> Setting:
    """An office where each of so many books is to be delivered to a room of its own."""

    def goal(draw: Random) -> list[Literal]:
        names = book_names(books)
        return [literal for each in names for literal in delivered([each], draw.choice(_ROOMS))]

    return Setting(office(books), goal)


def _lit(_draw: Random) -> list[Literal]:
    return [Literal.of("burning", (f"beacon{number}",)) for number in range(1, 10)]


_ROOMS = room_names(4)
SETTINGS: Mapping[str, Setting] = {
    "office": _office(2),
    "three books": _office(3),
    "coast": Setting(COAST, _lit),
}
VARIANTS: Mapping[str, tuple[Knowledge, Mapping[str, Any]]] = {
    "complete": ("complete", {}),
    "partial": ("seen", {}),
    "distrusted": ("complete", {"mode": "always", "probability": 0.5, "false_reports": 0.1}),
    "late": ("complete", {"mode": "always", "probability": 0.7, "delay": 8}),
    "all": ("seen", {"mode": "always", "probability": 0.7, "false_reports": 0.05, "delay": 8}),
}
"""What the robot knows of the start, and what it is told of events of any kind."""


@dataclass(frozen=True)
class Kind:
    """Games of a kind: where, what the robot heeds, what it knows and is told."""

    setting: str
    relevance: str
    variant: str


def games(kind: Kind, number: int, steps: int, folder: Path) -> list[TrialSpec]:
    """So many games, which last so many steps, each with a goal and a beginning that are drawn.

    Their domain is written to the folder, where it has to stay until they have been played.
    """
    setting = SETTINGS[kind.setting]
    path = folder / f"{kind.setting}.al"
    path.write_text(setting.text, encoding="utf-8")
    draw, world = Random(number), load_world(str(path))
    knowledge, told = VARIANTS[kind.variant]
    common = {
        "name": "hostile",
        "domain": str(path),
        "knowledge": knowledge,
        "observability": {event.name: told for event in world.exogenous_actions} if told else {},
        "relevance": kind.relevance,
        "limits": {"steps": steps},
        "robots": ["intentional"],
        "link": "inprocess",
        "scenarios": ["besieged"],
        "limit": 1,
        "exogenous_while_thinking": True,
        "adversary": {"strategy": "benchmarks.besieger:Besieger"},
    }
    found: list[TrialSpec] = []
    while len(found) < number:
        goal = setting.goal(draw)
        keys = {**common, "goal": [*map(str, goal)], "seed": len(found)}
        (spec,) = plan_trials(ExperimentConfig.model_validate(keys))
        if not world.satisfies(world.state(spec.initial), goal):
            found.append(spec)
    return found
