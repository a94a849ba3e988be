"""Incremental reasoning gives the answers of the theory solved from scratch, each decision."""

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from agents.intentional import IntentionalRobot
from agents.intentional.activities import History
from agents.intentional.reasoners import IncrementalReasoner, ReferenceReasoner
from agents.shared import MakeReasoner
from asp.reasoning import knowledge
from asp.reasoning.diagnosis import SELECT, Explanation
from benchmarks.offices import book_names, office
from tests.agents.both_ways import EARLY, both_ways
from tests.agents.intentional.lives import BOTH_IN_THE_LIBRARY, GOAL_LITERALS, STATES, Wish, live
from tests.literals import parsed

BOTH = both_ways(IncrementalReasoner, ReferenceReasoner)
BOTH_COMPRESSED = both_ways(IncrementalReasoner, ReferenceReasoner, EARLY)

wishes = st.dictionaries(
    st.integers(1, 25),
    st.builds(Wish, st.integers(0, 8), st.booleans(), st.booleans(), st.integers(0, 3)),
    max_size=3,
)


@settings(max_examples=12)
@given(initial=st.sampled_from(STATES), wishes=wishes)
def test_every_decision_of_a_life_is_the_same(initial: int, wishes: dict[int, Wish]) -> None:
    live(IntentionalRobot(BOTH), initial, BOTH_IN_THE_LIBRARY, wishes, steps=30)


@settings(max_examples=8)
@given(initial=st.sampled_from(STATES), wishes=wishes)
def test_whatever_is_compressed(initial: int, wishes: dict[int, Wish]) -> None:
    live(IntentionalRobot(BOTH_COMPRESSED), initial, BOTH_IN_THE_LIBRARY, wishes, steps=30)


@pytest.mark.parametrize("reasoner", [BOTH, BOTH_COMPRESSED], ids=["whole", "compressed"])
@settings(max_examples=8)
@given(
    initial=st.sampled_from(STATES), wishes=wishes, failing=st.sets(st.integers(2, 12), max_size=4)
)
def test_whatever_fails_in_its_execution(
    reasoner: MakeReasoner[History], initial: int, wishes: dict[int, Wish], failing: set[int]
) -> None:
    robot = IntentionalRobot(reasoner)
    live(robot, initial, BOTH_IN_THE_LIBRARY, wishes, steps=30, failing=failing)


@settings(max_examples=12)
@given(
    initial=st.sampled_from(STATES),
    goal=st.lists(st.sampled_from(GOAL_LITERALS), min_size=1, max_size=2),
    wishes=wishes,
)
def test_whatever_the_goal(initial: int, goal: list[str], wishes: dict[int, Wish]) -> None:
    live(IntentionalRobot(BOTH), initial, goal, wishes, steps=15)


@pytest.mark.parametrize("gone", [3, 4, 5, 7])
def test_as_many_events_as_are_needed_at_one_step_and_no_more(gone: int) -> None:
    """A robot sees so many books in its room, and at the next step none."""
    large = knowledge("office", office(gone))
    true = {"loc(rob1,kitchen)", *parsed(f"loc({book},kitchen)" for book in book_names(gone))}
    history = History(step=1)
    history.observe(
        parsed([f if f in true else f.complement for f in large.description.fluents]), 0
    )
    history.happened(SELECT, True, 0)
    history.step = 2
    history.observe(parsed([f"-loc({book},kitchen)" for book in book_names(gone)]), 2)
    both = BOTH(large, parsed(["loc(rob1,library)"]), 9, "optimistic")
    explained = both.diagnose(history, Explanation())
    assert explained.explanation.size == gone
    both.intend(history, explained)
