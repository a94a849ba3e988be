"""Whole trials in random descriptions: who reasons incrementally decides as the reference does."""

from collections.abc import Iterator, Sequence
from itertools import zip_longest
from random import Random
from typing import Any

import msgspec

from benchmarks.descriptions.case import Case, agree
from benchmarks.descriptions.definition import Definition, Goal, State
from benchmarks.descriptions.drawing import random_goal
from benchmarks.own import Own
from testbed.config import ConfigError
from testbed.experiment.digest import logical
from testbed.experiment.record import TrialRecord
from testbed.experiment.storyteller import Moment

REFERENCES = {"intentional": "intentional-plain", "traditional": "traditional-plain"}
"""The reference of each robot."""

_STEPS, _PLAN = 9, 3
_DRAWN = 1, 40, 80
_NAMES = ("trial", "robot")


def check_lives(case: Case) -> None:
    """Every decision of a random game, and what comes of it, is that of the reference.

    A game is refused where no state has the goal, or for its description.
    """
    (initial, goal), setting = _beginning(case), _setting(case.definition, case.random)
    setting |= {"goal": list(goal), "initial": sorted(initial & {*case.definition.inertial})}
    can_hold = any(case.definition.satisfies(state, goal) for state in case.definition.states)
    own = Own(case.folder, case.description.text)
    try:
        games = [*own.play(robots=[*REFERENCES, *REFERENCES.values()], **setting)]
    except ConfigError as error:
        is_of_goal = [": goal: " in line for line in str(error).splitlines()]
        if all(is_of_goal):
            agree(f"refused: {error}", definition=can_hold, configuration=False)
        return
    agree(f"{goal} can hold", definition=can_hold, configuration=True)
    lives = {record.robot: [*_life(record, moments)] for record, moments in games}
    for robot, reference in REFERENCES.items():
        pairs = zip_longest(lives[robot], lives[reference])
        for line, (ours, theirs) in enumerate(pairs):
            what = f"line {line} of the life of {robot} with {setting}"
            agree(what, incremental=ours, reference=theirs)


def _beginning(case: Case) -> tuple[State, Goal]:
    """An initial state and a goal: of some pairs the one with the longest plan, if any has one."""
    known, random = case.definition, case.random
    drawn = [
        (random.choice(known.initial), random_goal(case.description, random))
        for _ in range(random.choice(_DRAWN))
    ]
    return max(drawn, key=lambda pair: len(known.plan(*pair) or ()))


def _setting(known: Definition, random: Random) -> dict[str, Any]:
    """What the robot knows, heeds and is told, and how often something happens."""
    return {
        "knowledge": random.choice(["complete", "seen"]),
        "plans": random.choice(["optimistic", "conformant"]),
        "relevance": random.choice(["published", "definition", "plan", "all"]),
        "goal_feedback": random.random() < 0.8,
        "exogenous_while_thinking": random.random() < 0.7,
        "seed": random.randrange(1 << 30),
        "observability": {
            event.partition("(")[0]: {
                "mode": random.choice(["never", "always", "colocated"]),
                "probability": random.choice([0.5, 1.0]),
                "false_reports": random.choice([0.0, 0.0, 0.1]),
                "delay": random.choice([0, 0, 2]),
            }
            for event in known.others
        },
        "adversary": {"strategy": "random", "rate": random.choice([0.0, 0.4, 0.8])},
        "limits": {"steps": _STEPS, "plan": _PLAN, "decision_s": None},
    }


def _life(record: TrialRecord, moments: Sequence[Moment]) -> Iterator[object]:
    """The decisions of a trial, and then its record, without names and times."""
    for moment in moments:
        decision = msgspec.to_builtins(moment.decision, enc_hook=str)
        trace = {key: own for key, own in decision["trace"].items() if not key.endswith("_s")}
        yield decision | {"trial": "", "trace": trace}
    yield {key: own for key, own in logical(record).items() if key not in _NAMES}
