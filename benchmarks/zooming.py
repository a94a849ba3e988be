"""Planning at the fine resolution, zoomed or not: literally, and with multi-shot sessions."""

import time
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from math import inf
from pathlib import Path

from matplotlib.figure import Figure

from asp.domains import LEVELS, LevelSize
from asp.language import Problems, signature_of
from asp.reasoning.fine_planning import FinePlan, IncrementalFinePlanner, LiteralProblem, NoPlan
from asp.refinement import zoom as zoomed_of
from benchmarks.fine_problems import FineProblem, drawn, refined
from benchmarks.measuring import median, no_collection, quantile, within
from benchmarks.sheets import DisagreementError, Row, Sheet, Value, gathered
from testbed.studies.levels.published import RATIOS

LIMIT = 200
NAMES = {"small": ("L1", "L2"), "full": tuple(LEVELS)}
EDGES = {"small": (2,), "full": (2, 4, 6, 8, 10, 14, 20)}
OBJECTS = {"small": (1,), "full": (1, 3, 10, 30, 100, 200)}
DRAWN = {"small": 4, "full": 200}
LITERAL = {"small": 1, "full": 3}
LIMIT_S = {"small": inf, "full": 100.0}

FIGURES = {
    "small": Path(__file__).parent / "results" / "zooming.png",
    "full": Path(__file__).parents[1] / "docs" / "images" / "zooming.png",
}
NOTES = (
    "zoom, whole: fast planner, processor time of each problem the second time; first: seconds of",
    "all problems together the first time, with what is grounded for them",
    "literal: the strong refinement with its tests, from scratch for each length up to the plan's;",
    "last: the last of these lengths alone; '>': one of the problems was given up",
)


def main(size: str) -> list[Sheet]:
    """Sheets `levels`, `cells`, `objects`, and a figure (`FIGURES`). Raises DisagreementError."""
    sheets = measure(size)
    draw(sheets, FIGURES[size])
    return sheets


def measure(size: str) -> list[Sheet]:
    """The sheets."""
    growth = NOTES[:2]
    return [
        Sheet("levels", "A refined plan at each level", gathered(_levels(size)), NOTES),
        Sheet("cells", "Growth with the cells of a room", gathered(_cells(size)), growth),
        Sheet("objects", "Growth with objects", gathered(_objects(size)), growth),
    ]


def _levels(size: str) -> Iterator[Row]:
    too_long: set[str] = set()
    for name in NAMES[size]:
        row = {"level": name, **_engineered(LEVELS[name], DRAWN[size])}
        problems = drawn(refined(LEVELS[name]), LITERAL[size], seed=2)
        for kind in ("literal_zoom", "last_zoom", "literal_whole", "last_whole"):
            took = None if kind in too_long else literal(problems, kind, LIMIT_S[size])
            row[f"{kind}_ms"] = took
            if isinstance(took, str):
                too_long.add(kind)
        row["times"] = _ratio(row["whole_ms"], row["zoom_ms"])
        row["literal_times"] = _ratio(row["last_whole_ms"], row["last_zoom_ms"])
        row["published_times"] = RATIOS.get(name, {}).get("refined_plan")
        yield row


def _cells(size: str) -> Iterator[Row]:
    for edge in EDGES[size]:
        level = LevelSize(5, edge, edge, ((3, 2),))
        yield {"cells": edge * edge, **_engineered(level, min(60, DRAWN[size]))}


def _objects(size: str) -> Iterator[Row]:
    for count in OBJECTS[size]:
        level = LevelSize(5, 4, 4, ((count, 2),))
        yield {"objects": count, **_engineered(level, min(60, DRAWN[size]))}


def _engineered(level: LevelSize, count: int) -> dict[str, Value]:
    """Both ways of planning with multi-shot sessions, each in a process of its own."""
    row: dict[str, Value] = {}
    found = {}
    for zoom in ("zoom", "whole"):
        fast = within(600.0, lambda z=zoom: _fast(level, z == "zoom", count))  # type: ignore[misc]
        found[zoom] = fast
        row |= {
            f"{zoom}_ms": median(fast.took_ms) if fast else "> 600 s",
            f"{zoom}_99_ms": quantile(fast.took_ms, 0.99) if fast else None,
            f"{zoom}_first_s": fast.first_s if fast else None,
            f"{zoom}_kept": fast.kept if fast else None,
        }
    zoomed, whole = found["zoom"], found["whole"]
    if zoomed and whole and zoomed.lengths != whole.lengths:
        raise DisagreementError(f"{level}: plans differ in length with zooming and without")
    row["longest"] = max(zoomed.lengths) if zoomed else None
    return row


@dataclass(frozen=True)
class _Fast:
    took_ms: list[float]
    lengths: list[int]
    first_s: float
    kept: int


def _fast(level: LevelSize, zoom: bool, count: int) -> _Fast:
    refinement = refined(level)
    planner = IncrementalFinePlanner(refinement.weak, refinement.weak_signature)
    problems = drawn(refinement, count, seed=1)
    for problem in problems:
        _ = problem.goal, problem.constants  # are the zooming's, not the planner's
    with no_collection():
        first = sum(cpu_ms(planner, problem, zoom)[0] for problem in problems)
        again = [cpu_ms(planner, problem, zoom) for problem in problems]
    return _Fast([took for took, _ in again], [n for _, n in again], first / 1e3, planner.kept)


def cpu_ms(planner: IncrementalFinePlanner, problem: FineProblem, zoom: bool) -> tuple[float, int]:
    """Processor time of a plan, which other work on the machine does not change, and its length."""
    began = time.process_time()
    plan = _plan(planner, problem, zoom)
    return (time.process_time() - began) * 1e3, len(plan)


def _plan(planner: IncrementalFinePlanner, problem: FineProblem, zoom: bool) -> FinePlan:
    constants = problem.constants if zoom else None
    plan = planner.plan(problem.start, problem.goal, LIMIT, constants)
    if isinstance(plan, NoPlan):
        raise DisagreementError(f"{plan.value}: {problem.transition.action}")
    return plan


def literal(problems: Sequence[FineProblem], kind: str, limit_s: float) -> Value:
    """The median of some problems, each in a process of its own; text where that takes longer."""
    took: list[float] = []
    for problem in problems:
        one = within(limit_s, lambda p=problem: _slow(p, "zoom" in kind, "last" in kind))  # type: ignore[misc]
        if one is None:
            return f"> {limit_s:.0f} s"
        took.append(one)
    return median(took)


def _slow(problem: FineProblem, zoom: bool, only_last: bool) -> float:
    """Milliseconds of the literal translation, which has to plan the same actions."""
    expected = _plan(_planner(problem), problem, zoom)
    refinement = problem.refinement
    source, signature = refinement.strong, refinement.strong_signature
    if zoom:
        source = zoomed_of(refinement.strong, refinement, problem.relevant)
        signature = signature_of(source, Problems(source.file))
    start = problem.start.within(signature.constants)
    lengths = _lengths(expected)
    with no_collection():
        began = time.perf_counter()
        plain = LiteralProblem(source, signature, start, problem.goal)
        tried = [plain.plan(length) for length in (lengths[-1:] if only_last else lengths)]
        took = (time.perf_counter() - began) * 1e3
    if tried[-1] is None or _physical(tried[-1]) != expected or any(tried[:-1]):
        raise DisagreementError(f"{problem.transition.action}: {tried[-1]} and {expected}")
    return took


def _physical(plan: FinePlan) -> FinePlan:
    """The plan without its tests."""
    return tuple(action for action in plan if not action.startswith("test_"))


def _planner(problem: FineProblem) -> IncrementalFinePlanner:
    return IncrementalFinePlanner(problem.refinement.weak, problem.refinement.weak_signature)


def _lengths(plan: FinePlan) -> range:
    """The lengths up to that of the plan with its tests: one an action, one before picking up."""
    taken = sum(action.startswith("fine_pickup(") for action in plan)
    return range(2 * len(plan) + taken + 1)


def _ratio(slow: Value, fast: Value) -> Value:
    if isinstance(slow, float) and isinstance(fast, float):
        return slow / fast
    return None


CURVES = {
    "zoom_ms": "zoomed, as the robots plan",
    "whole_ms": "whole, as the robots plan",
    "last_zoom_ms": "zoomed, literal, last length",
    "last_whole_ms": "whole, literal, last length",
}


def draw(sheets: Sequence[Sheet], path: Path) -> None:
    """Times of each sheet over its first column, on logarithmic scales, as PNG."""
    figure = Figure(figsize=(11, 3.6), layout="constrained")
    for axes, sheet in zip(figure.subplots(1, len(sheets), sharey=True), sheets, strict=True):
        over = next(iter(sheet.rows[0]))
        for column, label in CURVES.items():
            points = [(r[over], r[column]) for r in sheet.rows if isinstance(r.get(column), float)]
            if points:
                axes.plot(*zip(*points, strict=True), marker="o", label=label)
        axes.set(xlabel=LABELS[sheet.name], yscale="log")
        if not isinstance(sheet.rows[0][over], str):
            axes.set_xscale("log")
        axes.grid(visible=True, alpha=0.3)
    figure.axes[0].set_ylabel("a refined plan (ms)")
    figure.axes[0].legend(frameon=False, fontsize="small")
    path.parent.mkdir(parents=True, exist_ok=True)
    figure.savefig(path, dpi=130)


LABELS = {"levels": "level", "cells": "cells of a room", "objects": "objects"}
