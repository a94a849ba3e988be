"""Accuracy and ratios with intervals of a run of one's own."""

from collections.abc import Iterable, Mapping

from testbed.analysis.comparison import MEASURES, Compared, measured, with_apart
from testbed.analysis.table import table_of
from testbed.experiment.record import TrialRecord
from testbed.report.comparison import charts
from testbed.studies import Chart, Point
from tests.experiment.samples import a_record


def _pair(name: str, scenario: str = "1", **baseline: object) -> list[TrialRecord]:
    own = {"pair": name, "scenario": scenario, "plans": 1, "action_count": 4, "initial": [name]}
    mind = a_record(f"{name} i", **own)
    return [mind, a_record(f"{name} t", robot="traditional", **(own | baseline))]


def _drawn(records: Iterable[TrialRecord]) -> list[Chart]:
    robots = Compared("traditional", "intentional")
    return charts(
        with_apart(measured(table_of(records)), robots, ()), robots._asdict() | {"exhaustive": []}
    )


def _charts(*pairs: list[TrialRecord]) -> Mapping[str, Chart]:
    return {chart.name: chart for chart in _drawn(record for pair in pairs for record in pair)}


def test_every_measure_is_drawn_for_the_scenarios_with_several_pairs() -> None:
    found = _charts(
        _pair("a"), _pair("b"), _pair("c", "once"), _pair("d", "lent"), _pair("e", "lent")
    )
    assert len(found) == 1 + len(MEASURES)
    assert all(list(chart.places) == ["1", "lent"] for chart in found.values())


def test_there_is_nothing_to_draw_of_single_pairs_and_single_robots() -> None:
    assert _drawn(_pair("a")) == []
    alone = [record for name in "abc" for record in _pair(name)[:1]]
    assert _drawn(alone) == []


def test_pairs_that_are_apart_do_not_count() -> None:
    lost = _pair("a", outcome="robot_lost", correct=False)
    assert _drawn([*lost, *_pair("b")]) == []
    assert _drawn([*lost, *_pair("b"), *_pair("c")]) != []


def _actions(*pairs: list[TrialRecord]) -> Point:
    (series,) = _charts(*pairs)["compared-actions"].series
    (point,) = series.points
    return point


def test_pairs_from_one_state_make_no_interval() -> None:
    pairs = [_pair(name, action_count=count) for name, count in (("a", 4), ("b", 8))]
    apart = _actions(*pairs)
    assert (apart.value, apart.low, apart.high) == (1.5, 1.0, 2.0)
    for record in pairs[1]:
        record.initial = ["a"]
    same = _actions(*pairs)
    assert (same.value, same.low, same.high) == (1.5, None, None)


def test_a_robot_that_needs_twice_as_much_stands_at_two() -> None:
    point = _actions(*(_pair(name, action_count=8) for name in "ab"))
    assert (point.place, point.value, point.low, point.high) == ("1", 2.0, 2.0, 2.0)
