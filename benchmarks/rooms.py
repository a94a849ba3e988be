"""Plans in rooms of many cells: a control for each problem beside controls that are kept."""

from collections.abc import Iterator

from asp.domains import LevelSize
from asp.reasoning.fine_planning import IncrementalFinePlanner
from benchmarks.fine_problems import FineProblem, drawn, refined
from benchmarks.measuring import median, no_collection, within
from benchmarks.sheets import DisagreementError, Row, Sheet, gathered
from benchmarks.zooming import cpu_ms

EDGES = {"small": (2,), "full": (4, 6, 8, 10, 14, 20)}
DRAWN = {"small": 2, "full": 12}
LIMIT_S = 600.0
LARGEST = {"own": -1, "kept": 10**9}
NOTES = (
    "own: a control for each problem; kept: one for each length that occurs in a part;",
    "processor time of the same problems, asked of both in turn, and again of both",
)


def main(size: str) -> list[Sheet]:
    """Sheet `rooms`. Raises DisagreementError."""
    rows = gathered(_rows(size))
    return [Sheet("rooms", "A refined plan, zoomed, by the cells of a room", rows, NOTES)]


def _rows(size: str) -> Iterator[Row]:
    for edge in EDGES[size]:
        level = LevelSize(5, edge, edge, ((3, 2),))
        found = within(LIMIT_S, lambda one=level: _beside(one, DRAWN[size]))  # type: ignore[misc]
        yield {"cells": edge * edge, **(found or {})}


def _beside(level: LevelSize, count: int) -> Row:
    """What both kinds take in one process, in turn."""
    refinement = refined(level)
    planners = {
        kind: IncrementalFinePlanner(refinement.weak, refinement.weak_signature, largest=largest)
        for kind, largest in LARGEST.items()
    }
    problems = drawn(refinement, count, seed=1)
    for problem in problems:
        _ = problem.goal, problem.constants  # are the zooming's, not the planner's
    with no_collection():
        first, again = _asked(planners, problems), _asked(planners, problems)
    row: dict[str, float] = {}
    for kind in planners:
        row |= {f"{kind}_first_s": sum(first[kind]) / 1e3, f"{kind}_ms": median(again[kind])}
    return row | {"first_times": row["kept_first_s"] / row["own_first_s"]}


def _asked(
    planners: dict[str, IncrementalFinePlanner], problems: list[FineProblem]
) -> dict[str, list[float]]:
    """Milliseconds of each problem, by planner."""
    took: dict[str, list[float]] = {kind: [] for kind in planners}
    for problem in problems:
        lengths = set()
        for kind, planner in planners.items():
            spent, length = cpu_ms(planner, problem, zoom=True)
            took[kind].append(spent)
            lengths.add(length)
        if len(lengths) > 1:
            raise DisagreementError(f"{problem.transition.action}: plans differ in length")
    return took
