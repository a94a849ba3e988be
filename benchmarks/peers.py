"""Planning alone, ours beside planners that a user would take instead: same problems, same run."""

from collections.abc import Callable, Sequence
from dataclasses import replace
from math import inf

from agents.shared import sessions_of
from asp.language import Fluent, analyse, parse_description
from asp.reasoning import knowledge
from asp.reasoning.planning import Encoding
from benchmarks.measuring import forget, median, timed, within
from benchmarks.offices import book_names, office, room_names
from benchmarks.outsiders import FAST_DOWNWARD, Planner, outsiders
from benchmarks.problems import Problem, delivered, drawn, placed, prototypes
from benchmarks.sheets import DisagreementError, Row, Sheet, Value, gathered

LIMIT_S = {"small": inf, "full": 20.0}
REPEATS = {"small": 1, "full": 5}
ENOUGH_MS = 5e3
ALL_RUNS = 3  # imports, a first run and those that are counted share one limit
SMALL = ("P1", "P2")

Outcome = tuple[float, int | None]
"""Milliseconds, and the length of the plan."""


def main(size: str) -> list[Sheet]:
    """Sheets `peers` and `instances`. Raises DisagreementError."""
    parse_description(office(1, 3), "smallest.al")  # the language's grammar is read here
    problems = list(prototypes())
    if size == "small":
        problems = [p for p in problems if p.name in SMALL]
    else:
        problems += _generated()
    rows = gathered(_row(problem, REPEATS[size], LIMIT_S[size]) for problem in problems)
    notes = (
        "ours, from nothing: the domain read, grounded and planned in, in a process of its own",
        "(imports and the grammar not counted, as the others' are not);",
        "ours, again: after problems of other states in a process of its own; answers forgotten;",
        "others: from nothing, on operators of the same description (not counted; encoding ms);",
        "all: medians of some runs; – stands for a planner that is not installed",
    )
    return [Sheet("peers", "A shortest plan", rows, notes)]


def _generated() -> list[Problem]:
    """Problems with plans of up to 30 actions: more books, more rooms, farther ways."""
    far = Problem(
        "a corridor of 14 rooms",
        office(1, 14),
        placed({"book1": "office1"}, "library"),
        delivered(["book1"]),
    )
    three = Problem(
        "3 books from the first of 4 rooms",
        office(3, 4),
        placed(dict.fromkeys(book_names(3), room_names(4)[0]), "library"),
        delivered(book_names(3)),
    )
    return [
        three,
        far,
        *drawn(4, 8, "grid", 3, 1, 2),
        *drawn(2, 16, "grid", 2, 1, 2),
        *drawn(16, 8, "tree", 2, 1, 1),
        *drawn(4, 32, "grid", 2, 1, 1),
        *list(drawn(16, 32, "grid", 3, 1, 2))[1:],
    ]


def _row(problem: Problem, repeats: int, limit_s: float) -> Row:
    nothing = _often(repeats, limit_s, lambda: _ours_from_nothing(problem))
    again = _often(repeats, limit_s * 2, lambda: _ours_again(problem))
    encoding_ms, encoding = timed(lambda: Encoding(problem.description))
    row: dict[str, Value] = {
        "problem": problem.name,
        "actions": None,
        "ours_from_nothing_ms": _text(nothing, limit_s),
        "ours_again_ms": _text(again, limit_s * 2),
    }
    found = [outcome for outcome in (nothing, again) if outcome is not None]
    for name, planner in outsiders().items():
        if planner is None:
            row[f"{name}_ms"] = None
            continue
        outcome = within(limit_s * ALL_RUNS, _runs(planner, encoding, problem, repeats))
        row[f"{name}_ms"] = _text(outcome, limit_s * ALL_RUNS)
        found += [outcome] if outcome is not None else []
    if len({length for _, length in found}) != 1:
        raise DisagreementError(f"{problem.name}: plans of {[length for _, length in found]}")
    row["actions"] = found[0][1]
    theirs = row[f"{FAST_DOWNWARD}_ms"]
    return {
        **row,
        "encoding_ms": encoding_ms,
        "nothing_faster_than_Fast_Downward": _ratio(theirs, nothing),
        "again_faster_than_Fast_Downward": _ratio(theirs, again),
        "agree": len(found) > 1,
    }


def _often(repeats: int, limit_s: float, call: Callable[[], Outcome]) -> Outcome | None:
    """The median over some runs, each in a process of its own; None if one takes too long."""
    runs: list[Outcome] = []
    while len(runs) < repeats and sum(took for took, _ in runs) < ENOUGH_MS:
        run = within(limit_s, call)
        if run is None:
            return None
        runs.append(run)
    return median([took for took, _ in runs]), runs[0][1]


def _ratio(theirs: Value, ours: Outcome | None) -> Value:
    return theirs / ours[0] if ours is not None and isinstance(theirs, float) else None


def _text(outcome: Outcome | None, limit_s: float) -> Value:
    return f"> {limit_s:.0f} s" if outcome is None else outcome[0]


def _runs(
    planner: Planner, encoding: Encoding, problem: Problem, repeats: int
) -> Callable[[], Outcome]:
    """The median over some runs, of which the first, with its imports, is not counted."""

    def run() -> Outcome:
        _, length = timed(lambda: planner(encoding, problem.initial, problem.goal))
        took: list[float] = []
        while len(took) < repeats and sum(took) < ENOUGH_MS:
            took.append(timed(lambda: planner(encoding, problem.initial, problem.goal))[0])
        return median(took), length

    return run


def _ours_from_nothing(problem: Problem) -> Outcome:
    for read in (knowledge, parse_description, analyse):
        read.cache_clear()
    return timed(lambda: _plan(replace(problem)))


def _ours_again(problem: Problem) -> Outcome:
    """After other problems of the domain; the first plan of this one in its process."""
    for other in _others(problem):
        _plan(other)
    forget()
    return timed(lambda: _plan(problem))


def _others(problem: Problem) -> Sequence[Problem]:
    """The lock the other way round, and the robot where the first book is."""
    lock = Fluent.of("locked", ("library",))
    turned = replace(problem, initial=tuple({*problem.initial} ^ {lock}))
    where = {a.arguments[0]: a.arguments[1] for a in problem.initial if a.name == "loc"}
    home = Fluent.of("loc", ("rob1", where["book1"]))
    moved = [a for a in problem.initial if not a.startswith("loc(rob1,")]
    return (turned, replace(problem, initial=(*moved, home)))


def _plan(problem: Problem) -> int | None:
    plans = sessions_of(problem.knowledge).plans
    plan = plans.shortest(problem.state, problem.goal, problem.limit)
    return None if plan is None else len(plan)
