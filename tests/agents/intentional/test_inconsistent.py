"""A history that nothing explains: the robot says which observations cannot all hold."""

import pytest

from agents.intentional.activities import History
from asp.language import Literal
from asp.reasoning import goal_facts
from asp.reasoning.diagnosis import InconsistentHistoryError, cannot_hold, conflict
from asp.solving import fact
from tests.agents.intentional.test_reports import CART, Make, Mind, both
from tests.literals import parsed


@both
def test_a_gate_that_nobody_can_have_opened(reasoner: Make) -> None:
    mind = Mind(reasoner)
    mind.next()
    mind.next(seen=["shut", "at(left)"])
    mind.next(seen=["shut", "at(left)"])
    with pytest.raises(InconsistentHistoryError) as error:
        mind.next(seen=["-shut", "at(left)"])
    assert str(error.value) == (
        "inconsistent history: obs(shut) at 3 and obs(-shut) at 4 cannot both hold"
    )


@both
def test_the_result_of_an_attempt_may_belong_to_the_conflict(reasoner: Make) -> None:
    """Nothing opens the gate, and the robot, on the right, was told that it went there."""
    mind = Mind(reasoner)
    mind.next()
    mind.next(seen=["shut"])
    mind.history.attempt(Literal.parse("go(right)"), 2)
    mind.history.happened(Literal.parse("go(right)"), True, 2)
    with pytest.raises(
        InconsistentHistoryError, match=r"hpd\(go\(right\)\) at 2 and obs\(shut\) at 2"
    ):
        mind.next()


def test_an_attempt_that_cannot_have_succeeded_is_a_conflict_with_the_start() -> None:
    history = History()
    history.observe(parsed(["at(left)", "-at(right)", "-shut", "-lit"]), 0)
    history.attempt(Literal.parse("open"), 1)
    history.happened(Literal.parse("open"), True, 1)
    history.attempt(Literal.parse("open"), 2)
    history.happened(Literal.parse("open"), False, 2)
    history.step = 3
    facts = [*history.facts(), *goal_facts(parsed(["lit"]))]
    # What is open already cannot be opened.
    assert conflict(CART.program, facts, 3) is None
    history.observe(parsed(["shut"]), 2)
    facts = [*history.facts(), *goal_facts(parsed(["lit"]))]
    assert conflict(CART.program, facts, 3) == ("hpd(-open) at 2", "obs(shut) at 2")


def test_an_attempt_that_kept_failing_is_in_no_conflict() -> None:
    history = History()
    history.observe(parsed(["at(left)", "-at(right)", "-shut", "-lit"]), 0)
    history.attempt(Literal.parse("go(right)"), 0)
    history.happened(Literal.parse("go(right)"), False, 0)
    history.step = 1
    facts = [*history.facts(), *goal_facts(parsed(["lit"]))]
    assert conflict(CART.program, facts, 1) is not None
    history.failed(Literal.parse("go(right)"), 0)
    facts = [*history.facts(), *goal_facts(parsed(["lit"]))]
    assert conflict(CART.program, facts, 1) is None


def test_a_test_that_is_taken_for_wrong_is_in_no_conflict() -> None:
    history = History()
    history.observe(parsed(["shut"]), 1)
    history.observe(parsed(["-shut"]), 2)
    history.step = 2
    facts = [*history.facts(), *goal_facts(parsed(["lit"]))]
    assert conflict(CART.program, facts, 2) is not None
    history.distrust([(2, "shut")])
    facts = [*history.facts(), *goal_facts(parsed(["lit"]))]
    assert conflict(CART.program, facts, 2) is None


def test_what_is_told_of_the_goal_may_belong_to_the_conflict() -> None:
    history = History()
    history.observe(parsed(["my_goal"]), 2)
    history.observe(parsed(["-lit"]), 2)
    history.step = 2
    facts = [*history.facts(), *goal_facts(parsed(["lit"]))]
    assert conflict(CART.program, facts, 2) == ("obs(-lit) at 2", "obs(my_goal) at 2")


def test_what_an_initial_state_must_have_may_belong_to_the_conflict() -> None:
    history = History()
    history.observe(parsed(["-shut", "-lit"]), 0)
    facts = [*history.facts(), fact("initially", 1, "lit")]
    assert conflict(CART.program, facts, 0) == ("obs(-lit) at 0",)
    either = [*facts, fact("initially", 1, "shut")]
    assert conflict(CART.program, either, 0) == ("obs(-lit) at 0", "obs(-shut) at 0")


@pytest.mark.parametrize(
    ("observations", "sentence"),
    [
        (("a",), "a cannot hold"),
        (("a", "b"), "a and b cannot both hold"),
        (("a", "b", "c"), "a, b and c cannot all hold"),
    ],
)
def test_a_conflict_in_words(observations: tuple[str, ...], sentence: str) -> None:
    assert cannot_hold(observations) == sentence
