"""Conditions that come true only where what follows from them is so already."""

import pytest

from asp import Domain
from asp.language import analyse, syntax
from asp.language import variable_sorts as roles
from asp.reasoning.relevance import comes_true_only_while

HAND = """
sorts
  robot  = {rob1}.
  object = {cup, book}.
fluents
  inertial in_hand(robot, object).
  inertial glued(robot, object).
  inertial dark.
actions
  agent     pickup(robot, object).
  agent     wave(robot).
  exogenous hand_over(robot, object).
laws
  -in_hand(R, O1) if in_hand(R, O2), O1 != O2.
  pickup(R, O) causes in_hand(R, O).
  impossible pickup(R, O1) if in_hand(R, O2).
"""
GUARD = "  impossible pickup(R, O1) if in_hand(R, O2).\n"


def guarded(text: str) -> bool:
    """Whether nothing is taken into a hand that holds something, by the form of the laws."""
    source, _ = analyse(text)
    law = next(source.each(syntax.StateConstraint))
    return comes_true_only_while(next(iter(roles.literals(law.body))), law.head, source)


def test_an_action_that_is_impossible_before_is_guarded() -> None:
    assert guarded(HAND)
    assert guarded(HAND.replace(GUARD, "  impossible pickup(X, Y) if in_hand(X, Z).\n"))


@pytest.mark.parametrize(
    "other",
    [
        "",
        "  impossible pickup(R, O1) if in_hand(R, O2), dark.\n",
        "  impossible pickup(R, O1) if in_hand(R, O2), O1 != O2.\n",
        "  impossible pickup(R, O1) if -in_hand(R, O2).\n",
        "  impossible pickup(R, O1) if glued(R, O2).\n",
        "  impossible pickup(R, cup) if in_hand(R, O2).\n",
        "  impossible pickup(R, O1) if in_hand(R, cup).\n",
        "  impossible pickup(R, O) if in_hand(R, O).\n",
        "  impossible wave(R) if in_hand(R, O2).\n",
        "  impossible pickup(R, O1), wave(R) if in_hand(R, O2).\n",
    ],
)
def test_what_does_not_forbid_it_always_is_no_guard(other: str) -> None:
    """A condition that asks for two objects is one, but not by the form of the law alone."""
    assert not guarded(HAND.replace(GUARD, other))


@pytest.mark.parametrize(
    "law", ["hand_over(R, O) causes in_hand(R, O).", "in_hand(R, O) if glued(R, O)."]
)
def test_another_way_for_it_to_come_true_is_not_guarded(law: str) -> None:
    assert not guarded(f"{HAND}  {law}\n")


def test_what_makes_it_false_needs_no_guard() -> None:
    assert guarded(f"{HAND}  wave(R) causes -in_hand(R, O).\n")


BARN = """\
sorts
  farmer = {bea}.
  bale   = {hay, straw}.
fluents
  inertial ajar.
  inertial against(bale).
actions
  agent pull.
  agent lean(bale).
  agent drag(bale).
laws
  pull    causes ajar.
  lean(B) causes against(B).
  drag(B) causes -against(B).
  -ajar if against(B).
  impossible lean(B) if ajar.
sees
  bea sees ajar.
"""


def test_what_a_constraint_says_of_a_constant_may_be_in_the_way_of_a_plan() -> None:
    """No law says that it is impossible to pull a door against which a bale leans."""
    barn = Domain(BARN, "barn.al")
    assert barn.plan("against(hay)", "ajar") == ("drag(hay)", "pull")
    assert barn.plan("", "ajar") == ("pull",)
