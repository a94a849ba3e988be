"""Plans in cells: multi-shot sessions against the literal translation, and both against
a search through states."""

import random
from functools import partial

import pytest

from asp.domains import LevelSize
from asp.reasoning.fine_planning import (
    FinePlan,
    IncrementalFinePlanner,
    NoPlan,
    ReferenceFinePlanner,
)
from asp.refinement import Refinement, zoom
from tests.asp.reasoning.fine_planning.fine_problems import (
    FineProblem,
    drawn_problem,
    first_shortest,
    signature,
)
from tests.asp.refinement.levels import level, of_size

SMALL = {
    "L1": partial(level, "L1"),
    "L2": partial(level, "L2"),
    "one room": partial(of_size, LevelSize(1, 2, 2, ((1, 2),))),
    "long rooms": partial(of_size, LevelSize(3, 1, 3, ((1, 2), (1, 1)))),
}
LIMIT = 12
TESTS = 2 * LIMIT + 2


def _physical(plan: FinePlan) -> FinePlan:
    """The plan without its tests."""
    return tuple(action for action in plan if not action.startswith("test_"))


def _planner(refinement: Refinement) -> IncrementalFinePlanner:
    return IncrementalFinePlanner(refinement.weak, refinement.weak_signature)


def _plain(problem: FineProblem) -> tuple[str, ...] | NoPlan:
    """The plan of the literal translation of the zoomed strong refinement, tests included."""
    source = zoom(problem.refinement.strong, problem.refinement, problem.relevant)
    known = signature(source)
    start = problem.start.within(known.constants)
    return ReferenceFinePlanner(source, known).plan(start, problem.goal, TESTS)


@pytest.mark.parametrize("name", SMALL)
def test_the_plan_is_the_first_shortest_that_a_search_finds(name: str) -> None:
    draw, planner = random.Random(11), _planner(SMALL[name]())
    for _ in range(40):
        problem = drawn_problem(SMALL[name](), draw)
        found = planner.plan(problem.start, problem.goal, LIMIT)
        assert found == first_shortest(SMALL[name](), problem.start, problem.goal, LIMIT), problem


@pytest.mark.parametrize("name", SMALL)
def test_whole_and_zoomed_the_literal_translation_plans_the_same_actions(name: str) -> None:
    draw, planner = random.Random(12), _planner(SMALL[name]())
    for _ in range(10):
        problem = drawn_problem(SMALL[name](), draw)
        refinement = problem.refinement
        reference = ReferenceFinePlanner(refinement.strong, refinement.strong_signature)
        plain = reference.plan(problem.start, problem.goal, TESTS)
        assert not isinstance(plain, NoPlan)
        assert _physical(plain) == planner.plan(problem.start, problem.goal, LIMIT), problem


@pytest.mark.parametrize(("name", "count"), [("L2", 20), ("L3", 12), ("L4", 6)])
def test_zoomed_the_literal_translation_plans_the_same_actions(name: str, count: int) -> None:
    draw, planner = random.Random(13), _planner(level(name))
    for _ in range(count):
        problem = drawn_problem(level(name), draw)
        plain = _plain(problem)
        assert not isinstance(plain, NoPlan), problem
        found = planner.plan(problem.start, problem.goal, LIMIT, problem.constants)
        assert _physical(plain) == found, problem
