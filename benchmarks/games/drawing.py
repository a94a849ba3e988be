"""Random games: each follows from a number, and is a configuration with a script."""

import json
import random
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import cache
from typing import Any

from benchmarks.games.literals import ROBOT, ROOMS, SECURE
from benchmarks.games.office import OFFICES, Office, State
from benchmarks.games.relevance import RELEVANT
from testbed.config import load_config
from testbed.experiment.plan import plan_trials
from testbed.experiment.specs import TrialSpec

SHARES: Mapping[str, int] = {
    "intentional": 140,
    "traditional": 38,
    "intentional-checking": 10,
    "intentional-plain": 3,
    "traditional-plain": 3,
    "intentional-joint-staged": 3,
    "intentional-joint": 3,
}
"""The robots, with how often of two hundred games each plays: some solve programs from scratch."""
JOINT = ("intentional-joint", "intentional-joint-staged")
SLOW = {
    "intentional-plain": 14,
    "traditional-plain": 20,
    "intentional-joint-staged": 12,
    "intentional-joint": 12,
}
"""The most steps of games of robots that solve large programs from scratch."""
TIGHT: Sequence[Mapping[str, int]] = (
    {"expansions": 3},
    {"expansions": 12},
    {"ground_rules": 300},
    {"ground_rules": 3_000},
    {"conflicts": 1},
)


@dataclass(frozen=True)
class Game:
    """A game that can be played: who plays where for what, and what happens at which step.

    `options` are further keys of its configuration, `steps` its last step.
    """

    robot: str
    domain: str
    initial: tuple[str, ...]
    goal: tuple[str, ...]
    script: tuple[tuple[int, str], ...]
    steps: int
    seed: int = 0
    options: Mapping[str, Any] = field(default_factory=dict)

    @property
    def office(self) -> Office:
        return OFFICES[self.domain]

    @property
    def state(self) -> State:
        """The initial state."""
        return self.office.by_fluents[frozenset(self.initial)]

    @property
    def has_intentions(self) -> bool:
        return self.robot.startswith("intentional")

    @property
    def is_joint(self) -> bool:
        return self.robot in JOINT

    @property
    def knows_all(self) -> bool:
        return self.options.get("knowledge") != "seen"

    @property
    def relevance(self) -> str:
        return str(self.options.get("relevance", "definition"))

    @property
    def plan_limit(self) -> int:
        return int(self.options.get("limits.plan", 30))

    @property
    def is_limited(self) -> bool:
        """Whether its decisions have a tight limit."""
        return any(f"limits.{key}" in self.options for limits in TIGHT for key in limits)

    @property
    def keys(self) -> dict[str, Any]:
        """What it changes of the packaged configuration of its domain, by dotted key."""
        return {
            "robots": [self.robot],
            "scenarios": ["none"],
            "goal": self.goal,
            "initial": self.initial,
            "script": [{"step": step, "action": action} for step, action in self.script],
            "script_policy": "skip",
            "seed": self.seed,
            "limits.steps": self.steps,
            "limits.decision_s": None,
            "link": "inprocess",
            **self.options,
        }

    @property
    def spec(self) -> TrialSpec:
        """Its one trial."""
        base = _packaged(self.domain)
        keys = base.model_dump()
        for key, value in self.keys.items():
            *sections, name = key.split(".")
            section = keys
            for each in sections:
                section = section[each]
            section[name] = value
        (spec,) = plan_trials(type(base).model_validate(keys))
        return spec

    def __str__(self) -> str:
        keys = (f"'{key}={json.dumps(value)}'" for key, value in self.keys.items())
        return f"testbed run {self.domain} {' '.join(keys)}"


_packaged = cache(load_config)


def draw(number: int, robots: Mapping[str, int] = SHARES) -> Game:
    """The game of a number."""
    chance = random.Random(number)
    robot = chance.choices([*robots], [*robots.values()])[0]
    domain = chance.choices(["office", "library"], [7, 3])[0]
    office = OFFICES[domain]
    most = SLOW.get(robot) or chance.choices([12, 24, 48, 100], [40, 40, 15, 5])[0]
    steps = chance.randint(min(4, most), most)
    options = _options(chance)
    if robot == "intentional-joint":
        options["limits.plan"] = chance.randint(2, 6)  # whose horizon is always as long
    first = 1 if options["exogenous_while_thinking"] or not robot.startswith("intentional") else 2
    rate = chance.choice((0.15, 0.4, 0.7))
    goal = _goal(chance, office)
    happens = [step for step in range(first, steps + 1) if chance.random() < rate]
    return Game(
        robot=robot,
        domain=domain,
        initial=tuple(sorted(office.fluents(_state(chance, office, goal)))),
        goal=goal,
        script=tuple((step, chance.choice(office.events)) for step in happens),
        steps=steps,
        seed=number,
        options=options,
    )


def _options(chance: random.Random) -> dict[str, Any]:
    options: dict[str, Any] = {
        "relevance": chance.choice([*RELEVANT]),
        "knowledge": chance.choices(["complete", "seen"], [6, 4])[0],
        "observability": {kind: _observability(chance) for kind in ("exo_move", "exo_lock")},
        "goal_feedback": chance.random() < 0.75,
        "exogenous_while_thinking": chance.random() < 0.5,
    }
    if chance.random() < 0.8:
        options["limits.judge_states"] = 1
    if chance.random() < 0.15:
        options["limits.plan"] = chance.randint(1, 12)
    if chance.random() < 0.06:
        options |= {f"limits.{key}": n for key, n in chance.choice(TIGHT).items()}
    return options


def _observability(chance: random.Random) -> dict[str, Any]:
    return {
        "mode": chance.choices(["never", "colocated", "always"], [5, 2, 3])[0],
        "probability": chance.choice((1.0, 0.5)),
        "false_reports": chance.choice((0.0, 0.0, 0.1, 0.3)),
        "delay": chance.choice((0, 0, 1, 3, 6)),
    }


def _goal(chance: random.Random, office: Office) -> tuple[str, ...]:
    """One to four literals of any kind that can hold together."""
    while True:
        number = chance.choices([1, 2, 3, 4], [1, 3, 4, 3])[0]
        goal = {_literal(chance, office) for _ in range(number)}
        if any(office.agrees(state, goal) for state in office.states):
            return tuple(sorted(goal))


def _state(chance: random.Random, office: Office, goal: Sequence[str]) -> State:
    """Mostly one from which a plan leads to the goal, which does not hold yet."""
    while True:
        state = chance.choice(office.states)
        if office.distances(goal).get(state) or chance.random() < 0.05:
            return state


def _literal(chance: random.Random, office: Office) -> str:
    book, room = chance.choice(office.books), chance.choice(ROOMS)
    kinds = (
        f"loc({book},{room})",
        f"in_hand({ROBOT},{book})",
        f"loc({ROBOT},{room})",
        f"locked({SECURE})",
    )
    fluent = chance.choices(kinds, [6, 2, 1, 1])[0]
    return f"-{fluent}" if chance.random() < 0.3 else fluent


def smaller(game: Game) -> list[Game]:
    """Games that are a little smaller: the story of a fault gets shorter by them."""

    def without(name: str) -> Iterator[Game]:
        own = getattr(game, name)
        for number in range(len(own)):
            yield replace(game, **{name: own[:number] + own[number + 1 :]})

    found = [replace(game, steps=n) for n in (game.steps // 2, game.steps - 1) if n > 0]
    found += without("script")
    found += without("goal") if len(game.goal) > 1 else ()
    # An event at step 1 is refused unless things may happen while the robot thinks.
    needed = "exogenous_while_thinking" if any(step == 1 for step, _ in game.script) else ""
    for key in game.options:
        if key != needed:
            left = {other: value for other, value in game.options.items() if other != key}
            found.append(replace(game, options=left))
    return found
