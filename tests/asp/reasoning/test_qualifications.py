"""Where actions have no successor though no law says so: the conditions that are derived."""

from pathlib import Path

import pytest

from asp.language import parse_description
from asp.reasoning.contradictions import suspects
from asp.reasoning.qualifications import qualifications
from asp.translation import translate
from benchmarks.descriptions.case import Case
from benchmarks.descriptions.transitions import check_qualifications

DOOR = """
fluents
  inertial open.
  inertial locked.
  inertial oiled.
  defined  silent.
actions
  agent push.
  agent oil.
laws
  push causes open if -locked.
  push causes open if oiled.
  oil causes oiled.
  silent if oiled, open.
  -open if locked.
"""


def _conditions(text: str) -> set[tuple[str, frozenset[str]]]:
    found = qualifications(parse_description(text), translate(text))
    return {(str(one.action), frozenset(map(str, one.body))) for one in found}


def test_a_condition_has_what_is_needed_and_no_more() -> None:
    assert _conditions(DOOR) == {("push", frozenset({"locked", "oiled"}))}


def test_actions_that_are_alike_have_conditions_that_are_alike() -> None:
    doors = """
sorts
  door = {north, south, east}.
  bolt = {upper, lower}.
fluents
  inertial open(door).
  inertial shut(door, bolt).
  inertial jammed(door).
actions
  agent push(door, bolt).
laws
  push(D, B) causes open(D).
  push(D, B) causes -shut(D, B).
  -open(D) if shut(D, B).
  -open(D1) if jammed(D2), D1 != D2.
"""
    other, doors_of = {"upper": "lower", "lower": "upper"}, {"north", "south", "east"}
    expected = {
        (f"push({door},{bolt})", frozenset({literal}))
        for door in doors_of
        for bolt in other
        for literal in (f"shut({door},{other[bolt]})", *(f"jammed({d})" for d in doors_of - {door}))
    }
    assert _conditions(doors) == expected
    told_apart = doors + "  impossible push(north, upper) if jammed(south).\n"
    assert _conditions(told_apart) == expected - {
        ("push(north,upper)", frozenset({"jammed(south)"}))
    }


def test_there_is_none_where_a_law_says_it() -> None:
    assert _conditions(DOOR + "  impossible push if locked.\n") == set()


def test_an_action_with_two_outcomes_has_none() -> None:
    """Where it is oiled one of two hinges gives way, whichever."""
    hinges = "  -left if right, oiled.\n  -right if left, oiled.\n"
    text = DOOR.replace("  defined", "  inertial left.\n  inertial right.\n  defined") + hinges
    assert "oil" in map(str, suspects(parse_description(text)))
    assert {action for action, _ in _conditions(text)} == {"push"}


def test_what_the_form_of_laws_clears_is_not_looked_at() -> None:
    assert [str(action) for action in suspects(parse_description(DOOR))] == ["push"]


@pytest.mark.parametrize("seed", range(100, 130))
def test_random_descriptions_have_the_conditions_of_their_definition(
    seed: int, tmp_path: Path
) -> None:
    case = Case.of(seed, tmp_path)
    if case.is_of_the_language:
        check_qualifications(case)
