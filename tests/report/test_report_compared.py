"""Accuracy and ratios with intervals of a run of one's own."""

from testbed.analysis.outline import MEASURES
from testbed.experiment.record import TrialRecord
from testbed.report import compared
from tests.experiment.samples import a_record


def _pair(name: str, scenario: str = "1", **baseline: object) -> list[TrialRecord]:
    own = {"pair": name, "scenario": scenario, "plans": 1, "action_count": 4, "initial": [name]}
    mind = a_record(f"{name} i", **own)
    return [mind, a_record(f"{name} t", robot="traditional", **(own | baseline))]


def test_every_measure_is_drawn_for_the_scenarios_with_several_pairs() -> None:
    records = [
        *_pair("a"),
        *_pair("b"),
        *_pair("c", "once"),
        *_pair("d", "lent"),
        *_pair("e", "lent"),
    ]
    panels = compared.panels(records, ())
    assert len(panels) == 1 + len(MEASURES)
    for panel in panels:
        texts = panel.svg.striptags().split()
        assert "lent" in texts
        assert "once" not in texts


def test_there_is_nothing_to_draw_of_single_pairs_and_single_robots() -> None:
    assert compared.panels(_pair("a"), ()) == []
    alone = [record for name in "abc" for record in _pair(name)[:1]]
    assert compared.panels(alone, ()) == []


def test_pairs_that_are_apart_do_not_count() -> None:
    lost = _pair("a", outcome="robot_lost", correct=False)
    assert compared.panels([*lost, *_pair("b")], {"a"}) == []
    assert compared.panels([*lost, *_pair("b"), *_pair("c")], {"a"}) != []


def test_pairs_from_one_state_make_no_interval() -> None:
    pairs = [_pair(name, action_count=count) for name, count in (("a", 4), ("b", 8))]
    (apart,) = compared._ratios(_groups(*pairs), MEASURES["actions"]).points
    assert (apart.value, apart.low, apart.high) == (1.5, 1.0, 2.0)
    for record in pairs[1]:
        record.initial = ["a"]
    (same,) = compared._ratios(_groups(*pairs), MEASURES["actions"]).points
    assert (same.value, same.low, same.high) == (1.5, None, None)


def _groups(*pairs: list[TrialRecord]) -> dict[str, list[compared.Pair]]:
    return compared._groups(record for pair in pairs for record in pair)


def test_a_robot_that_needs_twice_as_much_stands_at_two() -> None:
    pairs = [_pair(name, action_count=8) for name in "ab"]
    (point,) = compared._ratios(_groups(*pairs), MEASURES["actions"]).points
    assert (point.place, point.value, point.low, point.high) == ("1", 2.0, 2.0, 2.0)
