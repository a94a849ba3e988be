"""Attributes that are not magnified, where the robot cannot see what becomes of them."""

import re
from functools import cache
from importlib.resources import files
from pathlib import Path

import pytest

from agents.intentional import IntentionalRobot
from agents.intentional.refined import RefinedRobot
from asp.domains import level_text
from asp.language import read_domain
from asp.reasoning.fine_planning import IncrementalFinePlanner
from asp.refinement import Refinement, load
from asp.translation import NotCompactError
from tests.agents.intentional.executor.faulty_world import NO_FAULTS, TEXTS, Faults, Play, play
from tests.literals import parsed


def _refinement(coarse: str, fine: str) -> Refinement:
    refinement = load(coarse, "faulty.al", fine, "faulty.fine")
    TEXTS[refinement] = fine
    return refinement


@cache
def _blind_office() -> Refinement:
    """The packaged office, in which no robot sees whether a room is locked."""
    shown = re.compile(r"^  .*\b(?:sees|shows) +locked\(.*\n", re.MULTILINE)
    coarse, count = shown.subn("", read_domain("office")[1])
    assert count == 5
    return _refinement(
        coarse, files("asp").joinpath("domains", "office.fine").read_text(encoding="utf-8")
    )


START = parsed(["fine_loc(rob1,kitchen_1)", "fine_loc(book1_cover,office1_1)"])
START += parsed(["fine_loc(book2_cover,office1_2)"])


def entered(start: list[str], faults: Faults = NO_FAULTS, zooms: bool = True) -> Play:
    return play(
        RefinedRobot(IntentionalRobot(), zooms),
        _blind_office(),
        start,
        parsed(["loc(rob1,library)"]),
        faults,
    )


@pytest.mark.parametrize("zooms", [True, False])
def test_an_effect_that_nobody_sees_is_taken_for_certain(zooms: bool) -> None:
    went = entered([*START, "locked(library)"], zooms=zooms)
    assert went.achieved
    assert went.abstract == [("unlock(rob1,library)", True), ("move(rob1,library)", True)]
    assert went.actions.count("unlock(rob1,library)") == 1


@pytest.mark.parametrize("reported", [True, False])
def test_what_others_do_unseen_is_told_or_explained(reported: bool) -> None:
    locked = {("fine_move(rob1,kitchen_2)", 1): "exo_lock(library)"}
    locked |= {("fine_move(rob1,kitchen_3)", 1): "exo_lock(library)"}
    went = entered(START, Faults(events=locked, reported=reported))
    assert went.achieved
    assert went.actions.count("unlock(rob1,library)") == 1
    explained = [d.trace.explanation for d in went.decisions if d.trace.explanation is not None]
    events = [event.action for each in explained for event in each.unobserved]
    assert events == ([] if reported else ["exo_lock(library)"])


@cache
def _with_free_hands() -> Refinement:
    """A level in which a hand is busy once it has held something, and free until then."""
    coarse, fine = level_text(2, 1, 2, ((1, 2),))
    said = "  inertial loc(thing, room).\n"
    assert coarse.count(said) == 1
    coarse = coarse.replace(said, f"{said}  inertial free(robot).\n  inertial busy(robot).\n")
    coarse += "\nlaws\n  free(R) if -busy(R).\n  -free(R) if busy(R).\n"
    return _refinement(coarse + "  busy(R) if in_hand(R, O).\n", fine)


def test_an_indirect_effect_that_nobody_sees_follows() -> None:
    """By a law about what is false, so that its plans are those of the literal translation."""
    with pytest.raises(NotCompactError):
        IncrementalFinePlanner(_with_free_hands().weak, _with_free_hands().weak_signature)
    start = parsed(["fine_loc(rob1,room1_1)", "fine_loc(object1_1,room1_2)", "free(rob1)"])
    went = play(
        RefinedRobot(IntentionalRobot()), _with_free_hands(), start, parsed(["loc(object1,room2)"])
    )
    assert went.achieved
    assert went.abstract == [("pickup(rob1,object1)", True), ("move(rob1,room2)", True)]


@cache
def _table() -> Refinement:
    texts = Path(__file__).parents[3] / "asp" / "refinement"
    return _refinement(
        texts.joinpath("tabletop.al").read_text(encoding="utf-8"),
        texts.joinpath("tabletop.fine").read_text(encoding="utf-8"),
    )


@pytest.mark.parametrize("zooms", [True, False])
def test_what_is_defined_without_a_counterpart_does_not_stand_in_the_way(zooms: bool) -> None:
    start = parsed(
        ["fine_over(left_arm,green_3)", "fine_held(left_arm,base2)", "fine_lies(base1,yellow_1)"]
    )
    went = play(
        RefinedRobot(IntentionalRobot(), zooms), _table(), start, parsed(["lies(block1,red)"])
    )
    assert went.achieved
    assert [action for action, _ in went.abstract] == [
        "swing(left_arm,yellow)",
        "release(left_arm,block2)",
        "grasp(left_arm,block1)",
        "swing(left_arm,green)",
        "swing(left_arm,red)",
    ]
    assert all(happened for _, happened in went.abstract)


def test_what_is_tested_where_a_coarse_fluent_holds_is_tested_there() -> None:
    """`A tests covered(Z) if over(A, Z)`: `over` is defined at the fine resolution."""
    start = ["fine_over(left_arm,green_3)", "fine_lies(base1,yellow_1)", "fine_lies(base2,red_1)"]
    went = play(RefinedRobot(IntentionalRobot()), _table(), start, ["held(left_arm,block1)"])
    tested = {d.action for d in went.decisions if d.action.startswith("test_covered(")}
    assert went.achieved
    assert tested == {"test_covered(left_arm,green)", "test_covered(left_arm,yellow)"}
