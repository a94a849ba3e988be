"""Incremental reasoning gives the answers of the theory solved from scratch, each decision."""

from unittest.mock import patch

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from agents.intentional import IntentionalRobot
from agents.intentional.activities import History
from agents.intentional.reasoners import IncrementalReasoner, ReferenceReasoner
from agents.shared import Intention
from asp.reasoning import Knowledge, knowledge
from asp.reasoning.diagnosis import SELECT, Compression, Diagnosis, Explanation, incremental
from benchmarks.offices import book_names, office
from testbed.protocol import Plans
from tests.agents.intentional.lives import BOTH_IN_THE_LIBRARY, GOAL_LITERALS, STATES, Wish, live
from tests.literals import parsed


class Both:
    """Reasons in both ways, and insists that they agree."""

    def __init__(
        self,
        knowledge: Knowledge,
        goal: tuple[str, ...],
        plan_limit: int,
        plans: Plans = "optimistic",
    ) -> None:
        self._incremental = IncrementalReasoner(knowledge, goal, plan_limit, plans)
        self._reference = ReferenceReasoner(knowledge, goal, plan_limit, plans)

    def diagnose(self, history: History, adopted: Explanation) -> Diagnosis:
        ours = self._incremental.diagnose(history, adopted)
        theirs = self._reference.diagnose(history, adopted)
        assert ours == theirs
        return ours

    def intend(self, history: History, explained: Diagnosis) -> Intention:
        ours = self._incremental.intend(history, explained)
        theirs = self._reference.intend(history, explained)
        assert ours == theirs
        return ours


class BothCompressed(Both):
    """The incremental way compresses its history after a few steps already."""

    def __init__(
        self,
        knowledge: Knowledge,
        goal: tuple[str, ...],
        plan_limit: int,
        plans: Plans = "optimistic",
    ) -> None:
        compression = Compression(after=4, answers=400)
        with patch.object(incremental, "COMPRESSION", compression):
            super().__init__(knowledge, goal, plan_limit, plans)


wishes = st.dictionaries(
    st.integers(1, 25),
    st.builds(Wish, st.integers(0, 8), st.booleans(), st.booleans(), st.integers(0, 3)),
    max_size=3,
)


@settings(max_examples=12)
@given(initial=st.sampled_from(STATES), wishes=wishes)
def test_every_decision_of_a_life_is_the_same(initial: int, wishes: dict[int, Wish]) -> None:
    live(IntentionalRobot(Both), initial, BOTH_IN_THE_LIBRARY, wishes, steps=30)


@settings(max_examples=8)
@given(initial=st.sampled_from(STATES), wishes=wishes)
def test_whatever_is_compressed(initial: int, wishes: dict[int, Wish]) -> None:
    live(IntentionalRobot(BothCompressed), initial, BOTH_IN_THE_LIBRARY, wishes, steps=30)


@pytest.mark.parametrize("reasoner", [Both, BothCompressed])
@settings(max_examples=8)
@given(
    initial=st.sampled_from(STATES), wishes=wishes, failing=st.sets(st.integers(2, 12), max_size=4)
)
def test_whatever_fails_in_its_execution(
    reasoner: type[Both], initial: int, wishes: dict[int, Wish], failing: set[int]
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
    live(IntentionalRobot(Both), initial, goal, wishes, steps=15)


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
    both = Both(large, parsed(["loc(rob1,library)"]), 9)
    explained = both.diagnose(history, Explanation())
    assert explained.explanation.size == gone
    both.intend(history, explained)
