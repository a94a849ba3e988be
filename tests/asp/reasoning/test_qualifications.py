"""Where actions have no successor though no law says so: the conditions that are derived."""

from pathlib import Path

import pytest

from asp.language import analyse, parse_description
from asp.reasoning import knowledge
from asp.reasoning.contradictions import suspects
from asp.reasoning.qualifications import qualifications
from asp.reasoning.relevance import interchangeable
from asp.solving import LimitError
from asp.translation import translate
from benchmarks.descriptions.case import FILE, Case
from benchmarks.descriptions.language import mistakes
from benchmarks.descriptions.transitions import check_qualifications

SEEDS = range(100, 130)
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


def test_the_search_ends_where_there_are_exponentially_many() -> None:
    """Each of ten wedges is in, or one of two pins drives it in while the door opens: 3 ** 10."""
    number = 10
    wedges = "".join(
        f"  wedged{n} if open, left{n}.\n  wedged{n} if open, right{n}.\n" for n in range(number)
    )
    fluents = "".join(
        f"  inertial {name}{n}.\n" for name in ("left", "right", "wedged") for n in range(number)
    )
    together = ", ".join(f"wedged{n}" for n in range(number))
    text = (
        f"fluents\n  inertial open.\n{fluents}actions\n  agent push.\n"
        f"laws\n  push causes open.\n{wedges}  -open if {together}.\n"
    )
    found = qualifications(parse_description(text), translate(text))
    first = next(found)
    assert {str(each)[-1] for each in first.body} == set(map(str, range(number)))
    with pytest.raises(LimitError):
        list(found)
    rules = knowledge("door", text).program
    assert first.rule in rules  # what was found is known all the same


def test_random_descriptions_have_actions_that_are_alike_and_conditions(tmp_path: Path) -> None:
    """Otherwise the comparison below would say nothing of them."""
    counted = 0
    for seed in SEEDS:
        text = Case.of(seed, tmp_path).description.schematic.text
        if not mistakes(text, tmp_path / FILE):
            found = {one.action for one in qualifications(parse_description(text), translate(text))}
            classes = interchangeable(*analyse(text, FILE))
            alike = {constant for members in classes if len(members) > 1 for constant in members}
            counted += any(alike.intersection(action.arguments) for action in found)
    assert counted >= 3


@pytest.mark.parametrize("seed", SEEDS)
def test_random_descriptions_have_the_conditions_of_their_definition(
    seed: int, tmp_path: Path
) -> None:
    case = Case.of(seed, tmp_path)
    if case.is_of_the_language:
        check_qualifications(case)
