"""What only large problems need, left out: published studies and larger problems, with and without.

Each cell is a process of its own. A part is left out by the one switch that it has in the code.
"""

import math
import time
from collections.abc import Callable, Iterator, Mapping
from contextlib import ExitStack
from functools import partial
from itertools import product
from unittest.mock import patch

from asp.domains import LevelSize
from asp.reasoning.fine_planning import IncrementalFinePlanner
from asp.reasoning.planning import IncrementalPlanner
from asp.refinement import Refinement
from benchmarks import fine_problems, problems
from benchmarks.measuring import within
from benchmarks.offices import book_names, office
from benchmarks.sheets import DisagreementError, Row, Sheet, Value, gathered
from benchmarks.sieges import besiege
from testbed.config import load_config
from testbed.experiment.plan import plan_trials
from testbed.experiment.robots import make_robot
from testbed.experiment.specs import TrialSpec
from testbed.experiment.trial import play_trial
from testbed.link import InProcessRobot

SWITCHES: Mapping[str, tuple[str, object]] = {
    "state_sets": ("asp.reasoning.planning.incremental.STATE_SET_SEARCH", False),
    "problem_programs": ("asp.reasoning.fine_planning.incremental.LARGEST_SESSION", math.inf),
    "landmarks": ("asp.reasoning.fine_planning.incremental.LANDMARKS", False),
    "history_compression": ("asp.reasoning.diagnosis.incremental.COMPRESSION", None),
    "task_abstraction": ("agents.intentional.abstraction.TASK_ABSTRACTION", False),
}
"""Of each part what is set to leave it out."""

ROUNDS = {"small": 1, "full": 3}
LIMIT_S = {"small": math.inf, "full": 120.0}
TABLE1 = {"small": (), "full": (4,)}
LEVELS = {"small": (), "full": (("L1", "L2", "L3", "L4"), ("L5", "L6"), ("L7",), ("L8",))}
LIVES = {"small": (), "full": (50, 200, 500)}
OFFICES = {
    "small": ((2, 4, "row", 1),),
    "full": ((4, 8, "row", 2), (16, 8, "row", 3), (16, 16, "grid", 3), (16, 32, "grid", 4)),
}
EDGES = {"small": (2,), "full": (4, 8, 10, 14, 20)}
DRAWN = {"small": 1, "full": 8}
NOTES = (
    "with_all_s: processor time with all parts; others: how many times as long it takes without",
    "one; '>': it was given up. Each cell is the least of three processes of its own, with all",
    "that is prepared in them",
)

Answer = list[object]
Work = Callable[[], Answer]


def main(size: str) -> list[Sheet]:
    """Sheet `ablation`. Raises DisagreementError."""
    rows = gathered(_row(name, work, ROUNDS[size], LIMIT_S[size]) for name, work in _works(size))
    return [Sheet("ablation", "Parts left out, one at a time", rows, NOTES)]


def _works(size: str) -> Iterator[tuple[str, Work]]:
    for limit in TABLE1[size]:
        specs = plan_trials(load_config("table1", [f"limit={limit}"]))
        yield f"Table 1, {len(specs)} trials", partial(_played, specs)
    for levels in LEVELS[size]:
        specs = plan_trials(load_config("levels", [f"levels=[{','.join(levels)}]", "limit=2"]))
        yield f"levels, {', '.join(levels)}, {len(specs)} trials", partial(_played, specs)
    for steps in LIVES[size]:
        yield f"a life of {steps} steps", partial(_lived, steps)
    for books, rooms, shape, wanted in OFFICES[size]:
        asked = list(problems.drawn(books, rooms, shape, wanted, 1, 2))
        name = f"{wanted} of {books} books, {rooms} rooms in a {shape}"
        yield name, partial(_coarse, asked)
    for edge in EDGES[size]:
        refinement = fine_problems.refined(LevelSize(5, edge, edge, ((3, 2),)))
        drawn = fine_problems.drawn(refinement, DRAWN[size], seed=1)
        for problem in drawn:
            _ = problem.goal, problem.constants  # are the zooming's, not the planner's
        yield f"rooms of {edge * edge} cells", partial(_fine, refinement, drawn)


def _played(specs: list[TrialSpec]) -> Answer:
    """The actions of trials."""
    found: Answer = []
    for spec in specs:
        result = play_trial(spec, InProcessRobot(make_robot))
        if result.details is not None:
            raise RuntimeError(result.details)
        found.append([each.action for each in result.record.actions])
    return found


def _lived(steps: int) -> Answer:
    """The decisions of a life with an event now and then that nobody reports."""
    initial = problems.placed({"book1": "kitchen", "book2": "office1"}, "kitchen")
    goal = problems.delivered(book_names(2))
    life = besiege(office(), initial, goal, steps, silent=range(20, steps, 40))
    return [(each.action, str(each.trace.explanation)) for each in life.decisions]


def _coarse(asked: list[problems.Problem]) -> Answer:
    """Shortest plans at the coarse resolution."""
    planner = IncrementalPlanner(asked[0].source, "office.al")
    return [planner.shortest(each.state, each.goal, each.limit) for each in asked]


def _fine(refinement: Refinement, asked: list[fine_problems.FineProblem]) -> Answer:
    """Shortest plans at the fine resolution."""
    planner = IncrementalFinePlanner(refinement.weak, refinement.weak_signature)
    return [planner.plan(each.start, each.goal, 200, each.constants) for each in asked]


def _row(name: str, work: Work, rounds: int, limit_s: float) -> Row:
    least: dict[str, float] = {}
    answers: list[Answer] = []
    for number, part in product(range(rounds), ("", *SWITCHES)):
        if number and part not in least:
            continue  # it was given up
        found = _measured(work, limit_s, part)
        if found is not None:
            answers.append(found[0])
            least[part] = min(found[1], least.get(part, math.inf))
    if any(answer != answers[0] for answer in answers):
        raise DisagreementError(f"{name}: the answers differ")
    whole_s = least[""]
    row: dict[str, Value] = {"work": name, "with_all_s": whole_s}
    for part in SWITCHES:
        given_up = f"> {limit_s / whole_s:.0f}"
        row[f"{part}_times"] = least[part] / whole_s if part in least else given_up
    return row


def _measured(work: Work, limit_s: float, left_out: str) -> tuple[Answer, float] | None:
    """The answer with one part left out, and its seconds of processor time; None: too many."""

    def call() -> tuple[Answer, float]:
        with ExitStack() as stack:
            if left_out:
                stack.enter_context(patch(*SWITCHES[left_out]))
            began = time.process_time()
            return work(), time.process_time() - began

    return within(limit_s, call)
