"""After an attempt that took no effect, only what can be tested from where the robot is, is."""

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from itertools import pairwise
from pathlib import Path

import pytest

from asp.domains import LEVELS, level_text
from asp.language import Literal
from benchmarks.own import Own
from testbed.experiment.storyteller import Moment
from tests.experiment.gardens import GARDEN, PIECES

ROBOTS = ("intentional", "intentional-nozoom")


@dataclass(frozen=True)
class Walk:
    """A domain with its refinement: a move and its effect; an action of the hand and its effect.

    What the hand holds can be tested anywhere; with statements of `further` the move's effect, too.
    """

    domain: str
    refinement: str
    goal: str
    move: str
    place: str
    grasp: str
    held: str
    further: Mapping[str, str]

    def played(
        self, folder: Path, robot: str, failing: str, statement: str = ""
    ) -> Iterator[tuple[Moment, Moment]]:
        """Each step with the one that follows, of trials in which an action fails mostly."""
        own = Own(folder, self.domain, self.refinement + statement)
        trials = own.play(
            draw={"goal": [self.goal], "holding": 0.0},
            statistics={failing: 0.3},
            adversary={"strategy": "random", "rate": 0.0},
            robots=[robot],
            limit=4,
        )
        for record, moments in trials:
            assert record.outcome == "achieved"
            yield from pairwise(moments)


def _level(label: str) -> Walk:
    size = LEVELS[label]
    coarse, fine = level_text(size.rooms, size.rows, size.columns, size.objects)
    return Walk(
        domain=coarse,
        refinement=fine.replace("refines level.", 'refines "own.al".'),
        goal="loc(object,room)",
        move="fine_move",
        place="fine_loc",
        grasp="fine_pickup",
        held="fine_in_hand",
        further={
            "anywhere": "R tests fine_loc(R, C) if robot(R).",
            "beside": "R tests fine_loc(T, C) if robot(R), fine_loc(R, D), fine_next_to(D, C).",
        },
    )


WALKS = {
    "level L2": _level("L2"),
    "garden": Walk(
        domain=GARDEN.replace("OTHER", "rake"),
        refinement=PIECES.replace("OTHER", "rake"),
        goal="stands(tool,bed)",
        move="fine_walk",
        place="fine_stands",
        grasp="fine_lift",
        held="fine_carries",
        further={
            "anywhere": "H tests fine_stands(H, C) if helper(H).",
            "beside": "H tests fine_stands(X, C) if"
            " helper(H), fine_stands(H, D), fine_beside(D, C).",
        },
    ),
}


def _is_test(moment: Moment) -> bool:
    return moment.decision.action.name.startswith("test_")


@pytest.mark.parametrize("robot", ROBOTS)
@pytest.mark.parametrize("walk", WALKS)
def test_no_test_is_made_that_can_show_nothing(walk: str, robot: str, tmp_path: Path) -> None:
    here = WALKS[walk]
    steps = list(here.played(tmp_path, robot, here.move))
    failed = [one for one, _ in steps if one.happened is False]
    assert {one.decision.action.name for one in failed} == {here.move}
    tests = [(one, after) for one, after in steps if _is_test(one)]
    assert tests
    assert [one.decision.action for one, after in tests if not after.percept.visible] == []


@pytest.mark.parametrize("robot", ROBOTS)
@pytest.mark.parametrize("walk", WALKS)
@pytest.mark.parametrize("further", ["", "anywhere", "beside"])
def test_what_can_be_tested_from_where_the_robot_is_is_tested(
    walk: str, robot: str, further: str, tmp_path: Path
) -> None:
    here = WALKS[walk]
    failing, effect = (here.move, here.place) if further else (here.grasp, here.held)
    steps = list(here.played(tmp_path, robot, failing, here.further.get(further, "")))
    following = [pair for pair in pairwise(steps) if pair[0][0].happened is False]
    assert following
    for (one, _), (test, after) in following:
        action = one.decision.action
        assert action.name == failing
        inside = action.arguments
        about = (inside[0], *inside) if further else inside
        assert test.decision.action == Literal.of(f"test_{effect}", about)
        assert after.percept.visible == ["-" + Literal.of(effect, inside)]


@pytest.mark.parametrize("robot", ROBOTS)
@pytest.mark.parametrize("walk", WALKS)
def test_what_can_be_tested_from_beside_is_looked_for_from_there(
    walk: str, robot: str, tmp_path: Path
) -> None:
    """Where only the own cell can be tested, no two tests in a row are of different cells."""
    here = WALKS[walk]
    steps = list(here.played(tmp_path, robot, here.grasp, here.further["beside"]))
    looks = [
        (one.decision.action, following.decision.action)
        for one, following in steps
        if one.decision.action.name == following.decision.action.name == f"test_{here.place}"
    ]
    named = [(one.arguments, other.arguments) for one, other in looks]
    assert any(one[:2] == other[:2] and one != other for one, other in named)
    assert all(after.percept.visible for one, after in steps if _is_test(one))


WATERED = (
    GARDEN.replace("OTHER", "rake")
    .replace("  agent     walk", "  agent     water(helper, bed).\n  agent     walk")
    .replace("fluents\n", "fluents\n  inertial wet(bed).\n")
    .replace("laws\n", "laws\n  water(H, B) causes wet(B).\n  impossible water(H, B) if wet(B).\n")
)
"""A garden whose beds are watered: of that there is no test, and nobody sees it."""


@pytest.mark.parametrize("robot", ROBOTS)
def test_what_has_no_test_is_as_it_was(robot: str, tmp_path: Path) -> None:
    own = Own(tmp_path, WATERED, PIECES.replace("OTHER", "rake"))
    initial = ["fine_stands(tom,north_1)", "fine_stands(other_head,north_2)"]
    trials = own.play(
        goal=["wet(south)"],
        initial=[*initial, "fine_stands(spade_head,south_2)"],
        statistics={"water": 0.3},
        adversary={"strategy": "random", "rate": 0.0},
        robots=[robot],
        limit=6,
    )
    failures = 0
    for record, moments in trials:
        assert record.outcome == "achieved"
        assert [m.decision.action for m in moments].count("finish") == 1
        watered = [m.happened for m in moments if m.decision.action == "water(tom,south)"]
        assert watered.index(True) == len(watered) - 1
        failures += len(watered) - 1
    assert failures
