"""Plans from a program for one problem: those of multi-shot sessions, and of a search."""

import random
from functools import partial
from pathlib import Path

import pytest

from asp.domains import LevelSize
from asp.reasoning.fine_planning import IncrementalFinePlanner, NoPlan
from asp.refinement import Refinement, load, load_refinement
from tests.asp.reasoning.fine_planning.fine_problems import (
    drawn_goal,
    drawn_problem,
    drawn_state,
    first_shortest,
)
from tests.asp.refinement.levels import level, of_size
from tests.asp.refinement.locked import locked_texts

HERE = Path(__file__).parents[2] / "refinement"
SMALL = {
    "tabletop": partial(load_refinement, str(HERE / "tabletop.fine")),
    "assistant": partial(load_refinement, str(HERE / "assistant.fine")),
    "locked": lambda: load(*locked_texts()),
    "L1": partial(level, "L1"),
    "L2": partial(level, "L2"),
    "one room": partial(of_size, LevelSize(1, 2, 2, ((1, 2),))),
    "long rooms": partial(of_size, LevelSize(3, 1, 3, ((1, 2), (1, 1)))),
}
LARGE = {
    "L5": partial(level, "L5"),
    "wide rooms": partial(of_size, LevelSize(3, 5, 5, ((2, 2), (1, 1)))),
    "crossing": partial(of_size, LevelSize(2, 7, 4, ((1, 1),))),
}
LIMIT = 12


def _fitted(refinement: Refinement) -> IncrementalFinePlanner:
    """One that keeps no control, however small."""
    return IncrementalFinePlanner(refinement.weak, refinement.weak_signature, largest=-1)


def _kept(refinement: Refinement) -> IncrementalFinePlanner:
    """One that keeps each, however large."""
    return IncrementalFinePlanner(refinement.weak, refinement.weak_signature, largest=10**9)


@pytest.mark.parametrize("name", SMALL)
def test_the_plan_is_the_first_shortest_that_a_search_finds(name: str) -> None:
    draw, planner = random.Random(31), _fitted(SMALL[name]())
    for _ in range(15):
        start, goal = drawn_state(SMALL[name](), draw), drawn_goal(SMALL[name](), draw)
        found = planner.plan(start, goal, 6)
        expected = first_shortest(SMALL[name](), start, goal, 6)
        assert (None if isinstance(found, NoPlan) else found) == expected, (start, goal)


@pytest.mark.parametrize("name", ["L1", "L2", "one room", "long rooms"])
def test_of_candidates_the_same_are_assumed_as_by_a_search(name: str) -> None:
    draw, planner = random.Random(32), _fitted(SMALL[name]())
    for _ in range(15):
        problem = drawn_problem(SMALL[name](), draw)
        found = planner.plan(problem.start, problem.goal, LIMIT)
        assert found == first_shortest(SMALL[name](), problem.start, problem.goal, LIMIT), problem


@pytest.mark.parametrize("zoomed", [True, False], ids=["zoomed", "whole"])
@pytest.mark.parametrize("name", LARGE)
def test_kept_controls_plan_the_same(name: str, zoomed: bool) -> None:
    draw, fitted, kept = random.Random(33), _fitted(LARGE[name]()), _kept(LARGE[name]())
    for _ in range(12):
        problem = drawn_problem(LARGE[name](), draw)
        constants = problem.constants if zoomed else None
        found = fitted.plan(problem.start, problem.goal, 40, constants)
        assert found == kept.plan(problem.start, problem.goal, 40, constants), problem


@pytest.mark.parametrize("name", ["L2", "tabletop", "locked"])
def test_where_there_is_no_plan_of_a_length_both_say_so(name: str) -> None:
    refinement = SMALL[name]()
    draw, fitted, kept = random.Random(34), _fitted(refinement), _kept(refinement)
    for _ in range(12):
        start, goal = drawn_state(refinement, draw), drawn_goal(refinement, draw)
        assert fitted.plan(start, goal, 3) == kept.plan(start, goal, 3), (start, goal)
