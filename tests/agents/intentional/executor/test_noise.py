"""Tests that are wrong and actions that fail, as often as they like, are no errors of the robot."""

from functools import cache

from hypothesis import given, settings
from hypothesis import strategies as st

from agents.intentional import IntentionalRobot
from agents.intentional.refined import RefinedRobot
from asp.refinement import Refinement, load
from tests.agents.intentional.executor.faulty_world import TEXTS, Faults, play
from tests.agents.intentional.test_incremental import BOTH
from tests.experiment.gardens import GARDEN, PIECES
from tests.literals import parsed

# Nothing but the helper moves a tool, so that no event explains where one is found.
STILL = "\n".join(line for line in GARDEN.splitlines() if "stray" not in line)
PIECES_ONLY = PIECES.replace(" stray.", "")


@cache
def _garden() -> Refinement:
    coarse, fine = (text.replace("OTHER", "rake") for text in (STILL, PIECES_ONLY))
    refinement = load(coarse, "own.al", fine, "own.fine")
    TEXTS[refinement] = fine
    return refinement


START = parsed(
    [
        "fine_stands(tom,north_1)",
        "fine_stands(other_head,north_2)",
        "fine_stands(spade_head,south_2)",
    ]
)
ROWS = ("north_1", "north_2", "south_1", "south_2")


def test_a_thing_that_is_not_found_where_it_has_to_be_was_overlooked() -> None:
    overlooked = [("test_fine_stands(tom,other_head,north_2)", n) for n in (1, 2)]
    overlooked += [("test_fine_stands(tom,other_head,north_1)", n) for n in (1, 2)]
    went = play(
        RefinedRobot(IntentionalRobot()),
        _garden(),
        START,
        parsed(["stands(rake,south)"]),
        Faults(lies=overlooked),
    )
    assert went.achieved
    assert went.abstract[0] == ("lift(tom,rake)", False)
    explained = [d.trace.explanation for d in went.decisions if d.trace.explanation is not None]
    assert explained[0].unobserved == []
    assert "stands(rake,north)" in {told.action for told in explained[0].distrusted}


@settings(max_examples=15)
@given(
    lies=st.sets(
        st.tuples(
            st.builds("test_fine_stands(tom,other_head,{})".format, st.sampled_from(ROWS)),
            st.integers(1, 6),
        ),
        max_size=12,
    ),
    failing=st.integers(0, 30),
)
def test_both_ways_of_reasoning_bear_wrong_tests_alike(
    lies: set[tuple[str, int]], failing: int
) -> None:
    robot = RefinedRobot(IntentionalRobot(BOTH))
    slips = [("fine_lift(tom,other_head)", number + 1) for number in range(failing)]
    goal = parsed(["stands(rake,south)", "-carries(tom,rake)"])
    went = play(robot, _garden(), START, goal, Faults(lies=lies, slips=slips), steps=150)
    assert went.achieved or not went.finished
