"""The plan of trials at the fine resolution: what is drawn, under which ids."""

from collections import Counter

import pytest

from testbed.config import load_config
from testbed.experiment.plan import plan_trials
from testbed.experiment.specs import TrialSpec
from testbed.experiment.trial_setup import refinement_of
from testbed.world import world_of


def _specs(*overrides: str) -> list[TrialSpec]:
    given = ["robots=[intentional,traditional]", "limit=3", *overrides]
    return plan_trials(load_config("levels", given))


def test_a_pair_is_the_same_trial_for_each_robot() -> None:
    specs = _specs("levels=[L1,L2]")
    assert len(specs) == 2 * 3 * 2
    assert len({spec.trial for spec in specs}) == len(specs)
    for one, other in zip(specs[::2], specs[1::2], strict=True):
        assert {one.robot, other.robot} == {"intentional", "traditional"}
        shared = [(s.pair, s.level, s.seed, s.initial, s.setting) for s in (one, other)]
        assert shared[0] == shared[1]
    assert len({spec.pair for spec in specs}) == 6


FIRST = {
    "L1": (206143232, "34123083cb04"),
    "L2": (3711556231, "5d66ca77faca"),
    "L3": (1612959719, "4c07b44103c4"),
    "L4": (1084462637, "44e20ba2400f"),
    "L5": (1259841228, "d710dd6b87f9"),
    "L6": (3951043407, "a12325c85271"),
    "L7": (1640123453, "99222b9bf34b"),
    "L8": (4011359611, "10d389982098"),
}
"""Seed and id of the first trial with zooming: stored runs are resumed and replayed by them."""


def test_the_published_levels_keep_the_trials_of_stored_runs() -> None:
    specs = plan_trials(load_config("levels", ["limit=1", "robots=[intentional]"]))
    assert {spec.level: (spec.seed, spec.trial) for spec in specs} == FIRST


def _ids(*overrides: str) -> set[str]:
    return {spec.trial for spec in _specs("levels=[L1]", *overrides)}


@pytest.mark.parametrize(
    "override",
    [
        "seed=2",
        "statistics.fine_move=0.8",
        "adversary.rate=0.2",
        "adversary.pace=abstract",
        'draw.goal=["loc(object,room)", "-in_hand(robot,object)"]',
        "script=[]",
        "limits.steps=9",
        "observability.fine_exo_move.mode=always",
    ],
)
def test_what_a_result_may_depend_on_changes_every_id(override: str) -> None:
    assert not _ids() & _ids(override)


@pytest.mark.parametrize("override", ["draw.holding=1.0", "goal=[loc(object1,room2)]"])
def test_a_trial_that_comes_out_as_another_one_is_another_trial(override: str) -> None:
    assert _ids("limit=9") != _ids("limit=9", override)


def test_a_level_of_the_same_name_and_another_size_has_other_ids() -> None:
    def of_size(rooms: int) -> set[str]:
        size = f"{{rooms: {rooms}, rows: 1, columns: 2, objects: [[1, 1]]}}"
        return {s.trial for s in _specs("levels=[own]", f"level_sizes={{own: {size}}}")}

    assert not of_size(2) & of_size(3)


def test_neither_the_link_nor_a_larger_limit_nor_other_levels_change_an_id() -> None:
    assert _ids() == _ids("link=zenoh") == _ids("protocol=null") < _ids("limit=5")
    assert _ids() < {spec.trial for spec in _specs("levels=[L2,L1]")}


def test_a_drawn_goal_is_a_room_in_which_the_object_is_not() -> None:
    for spec in _specs("levels=[L3]", "limit=20"):
        state = world_of(refinement_of(spec.setting)).state(spec.initial)
        (goal,) = spec.setting.goal
        assert goal.startswith("loc(object")
        assert not world_of(refinement_of(spec.setting)).satisfies(state, (goal,))


def test_goals_and_places_are_drawn_from_all() -> None:
    specs = _specs("levels=[L1]", "limit=200", "robots=[intentional]")
    drawn = Counter(spec.setting.goal for spec in specs)
    assert set(drawn) == {("loc(object1,room1)",), ("loc(object1,room2)",)}
    places = {atom for spec in specs for atom in spec.initial if "rob1,room" in atom}
    assert len(places) == 4
    held = sum(any("in_hand" in atom for atom in spec.initial) for spec in specs)
    assert 20 <= held <= 60  # of 200 at 0.2: a mean of 40 with a deviation of 5.7
