"""Memory of a process that plays trial after trial."""

import gc
import os
import resource
from collections.abc import Callable, Iterator, Sequence
from itertools import cycle, islice, product
from pathlib import Path

import clingo

from benchmarks.offices import book_names, room_names
from benchmarks.sheets import Row, Sheet, gathered
from benchmarks.trials import SCENARIOS, play, specs
from testbed.config import load_config
from testbed.experiment.plan import plan_trials
from testbed.experiment.robots import make_robot
from testbed.experiment.specs import TrialSpec
from testbed.experiment.trial import play_trial
from testbed.link import InProcessRobot

_STATUS = Path("/proc/self/statm")

TRIALS = {"small": 300, "full": 10_000}
SAMPLES = 10
STATES = {"small": 2, "full": 192}

KINDS = ("intentional", "intentional-checking", "traditional")
FINE_KINDS = ("intentional", "intentional-nozoom")
LEVELS = {"small": ("L1", "L2"), "full": ("L1", "L2", "L3", "L4", "L5", "L6")}
GOALS = {"small": 2, "full": 24}
ROUNDS = {"small": 2, "full": 10}


def main(size: str) -> list[Sheet]:
    """Sheets `memory` and `goals`: resident memory after so many trials."""
    return [_with_one_goal(size), _with_many_goals(size)]


def _with_one_goal(size: str) -> Sheet:
    rows = soak(TRIALS[size], alike(STATES[size]), lambda spec: play(spec, "fast"))
    return Sheet(
        "memory",
        "Resident memory of one process, link included",
        gathered(rows),
        (
            "scenarios 1 to 6 in turn, from different initial states, nothing forgotten in",
            "between; the first row is after the first trial; controls are those of clingo then",
        ),
    )


def _with_many_goals(size: str) -> Sheet:
    pool = list(varied(GOALS[size], LEVELS[size]))
    return Sheet(
        "goals",
        "Resident memory of the same process, then, with goals, robots and levels that change",
        gathered(soak(ROUNDS[size] * len(pool), pool, play_any)),
        (
            f"{GOALS[size]} goals one after the other, each with {', '.join(KINDS)} in all",
            f"scenarios and from one initial state, then {' and '.join(FINE_KINDS)} at one of",
            f"{', '.join(LEVELS[size])}: {len(pool)} trials, and all of them {ROUNDS[size]} times;",
            "the domain of the robot that checks follows from its goal",
        ),
    )


def soak(
    trials: int, pool: Sequence[TrialSpec], play_one: Callable[[TrialSpec], object]
) -> Iterator[Row]:
    """Plays so many trials; a row after the first one and after each tenth of them."""
    before: float | None = None
    for number, spec in enumerate(islice(cycle(pool), trials), start=1):
        play_one(spec)
        if number == 1 or number % (trials // SAMPLES) == 0:
            now = resident_mb()
            yield {
                "trials": number,
                "resident_mb": now,
                "growth_mb": None if before is None else now - before,
                "controls": controls(),
            }
            before = now


def alike(states: int) -> list[TrialSpec]:
    """Trials of all scenarios with one goal and one robot, each from so many states."""
    return [spec for scenario in SCENARIOS for spec in specs(scenario, states)]


def varied(goals: int, levels: Sequence[str]) -> Iterator[TrialSpec]:
    """So many goals, each in all scenarios and with all robots, a level between one and the next.

    The task of a level is drawn; each time that a level comes up it is another one.
    """
    for number, goal in enumerate(islice(_goals(), goals)):
        overrides = [
            f"robots=[{','.join(KINDS)}]",
            f"scenarios=[{','.join(SCENARIOS)}]",
            f"goal=[{','.join(goal)}]",
            "limit=1",
        ]
        yield from plan_trials(load_config("office", overrides))
        yield from _at_level(levels[number % len(levels)], seed=number)


def _at_level(level: str, seed: int) -> Iterator[TrialSpec]:
    overrides = [f"robots=[{','.join(FINE_KINDS)}]", f"levels=[{level}]", "limit=1"]
    yield from plan_trials(load_config("levels", [*overrides, f"seed={seed}"]))


def _goals() -> Iterator[tuple[str, ...]]:
    """Each book in each room, alone, then each pair of books in each pair of rooms."""
    books, rooms = book_names(2), room_names(4)
    places = [[f"loc({book},{room})" for room in rooms] for book in books]
    for alone in places:
        yield from zip(alone)
    yield from product(*places)


def play_any(spec: TrialSpec) -> None:
    """One trial with the robot that it names. Raises RuntimeError if it failed."""
    result = play_trial(spec, InProcessRobot(make_robot))
    if result.details is not None:
        raise RuntimeError(result.details)


def resident_mb() -> float:
    """Resident memory of this process in MB; the most it ever had where there is no /proc."""
    if _STATUS.exists():
        pages = int(_STATUS.read_text(encoding="ascii").split()[1])
        return pages * os.sysconf("SC_PAGE_SIZE") / 1e6
    return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1e3


def controls() -> int:
    """How many controls of clingo there are in this process."""
    return sum(isinstance(found, clingo.Control) for found in gc.get_objects())
