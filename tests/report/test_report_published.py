"""Published values beside ours, as the studies show them."""

from pathlib import Path

import pytest

from testbed.analysis import Run
from testbed.analysis.bootstrap import Estimate
from testbed.analysis.pairs import Ratio
from testbed.analysis.statistics import Test
from testbed.analysis.table import table_of
from testbed.config import load_config
from testbed.experiment.runner import play_missing
from testbed.experiment.status import RunStatus
from testbed.experiment.store import TrialWriter, read_records
from testbed.report import write_report
from testbed.studies import Value, View, results_of
from testbed.studies.levels.published import NO_ZOOM, OWN, PAPER, ZOOM, Paper
from testbed.studies.levels.tables import ratio_charts
from testbed.studies.table1.measures import Analysis, Row, Table
from testbed.studies.table1.published import MEASURES, PUBLISHED
from testbed.studies.table1.tables import COLUMNS, charts, sections
from tests.experiment.samples import a_level_record, a_record
from tests.studies.levels.found import found, views
from tests.studies.table1.made import ROBOTS

ALWAYS = Estimate(1.0, 0.98, 1.0)


def _row(name: str, mean: Estimate | None, share: Estimate | None = ALWAYS) -> Row:
    ratio = Ratio(10, mean, mean, Test(0.01, 0.5, 0.02))
    return Row(name, 10, share, share, None, dict.fromkeys(MEASURES, ratio), {"same": 10})


def _analysis(*rows: Row, apart: dict[str, int] | None = None) -> Analysis:
    return Analysis(ROBOTS, {"triggered": Table(rows, apart or {})}, {})


def _view(analysis: Analysis) -> View:
    (section,) = sections([analysis])
    (view,) = section.views
    return view


def _values(row: Row) -> dict[str, Value]:
    (line,) = _view(_analysis(row)).lines
    return dict(zip(COLUMNS[2:], line.values, strict=True))


def test_ours_stands_with_its_interval_above_what_was_published() -> None:
    value = _values(_row("3", Estimate(1.234, 1.006, 1.999)))["actions"]
    assert (value.ours, value.ends, value.published) == ("1.23", ("1.01", "2.00"), "1.12")
    assert value.inside


def test_a_published_value_outside_of_our_interval_is_told_apart() -> None:
    low = PUBLISHED["3"].ratios["actions"]
    inside = [_values(_row("3", Estimate(2.0, end, 3.0)))["actions"].inside for end in (low, 1.2)]
    assert inside == [True, False]


def test_shares_are_percents_with_a_decimal_of_ours() -> None:
    row = _row("3", Estimate(1.0, 1.0, 1.0), Estimate(0.663, 0.624, 0.701))
    value = _values(row)["TP correct"]
    assert value == Value("66.3%", ("62.4", "70.1"), published="72%", inside=False)


def test_without_a_published_row_there_is_nothing_to_be_inside_of() -> None:
    value = _values(_row("6", Estimate(1.0, 1.0, 1.0)))["plans"]
    assert (value.published, value.inside) == ("", None)


def test_without_a_ratio_there_is_none() -> None:
    value = _values(_row("1", None))["planning time"]
    assert (value.ours, value.inside) == ("-", None)


def test_what_is_in_no_row_is_counted() -> None:
    apart, met = _view(_analysis(_row("3", None), apart={"no event": 7})).notes
    assert "7 pairs of no event" in apart
    assert met.startswith("10 pairs: ")


def test_every_measure_and_both_accuracies_are_drawn_and_published_values_with_them() -> None:
    drawn = charts(_analysis(_row("3", Estimate(1.2, 1.1, 1.3))))
    assert len({chart.name for chart in drawn}) == len(drawn) == len(MEASURES) + 2
    for chart in drawn:
        known = {own.colour: own.points for own in chart.series}
        assert known["first"]
        assert known["paper"]


@pytest.fixture(scope="module")
def small(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A run of the comparison that ends after one pair."""
    folder = tmp_path_factory.mktemp("table1")
    play_missing(load_config("table1", ["limit=1", "scenarios=[1]"]), folder, 1, _ignore)
    return folder


def _ignore(tally: RunStatus) -> None:
    del tally


def test_only_the_protocol_has_the_table(small: Path) -> None:
    records = table_of(read_records(small)).lazy()
    (own,) = results_of(Run(small, load_config("table1"), {}, records, ""))
    assert own.numbers["table1"]["intentional"]["triggered"] is not None
    assert results_of(Run(small, load_config("office"), {}, records, "")) == []


def test_a_run_in_which_no_pair_counts_has_a_report_that_says_why(tmp_path: Path) -> None:
    lost = {"outcome": "robot_lost", "achieved": False, "scenario": "3", "pair": "p"}
    with TrialWriter(tmp_path) as writer:
        for robot in ("intentional", "traditional"):
            writer.append(a_record(robot, robot=robot, **lost))
    tables = write_report(tmp_path, load_config("table1", ["scenarios=[3]"]))
    assert tables.grids == []
    page = (tmp_path / "report.html").read_text(encoding="utf-8")
    assert "1 pair with a lost trial" in page


def _views(*times: tuple[str, float]) -> dict[str, View]:
    records = [
        a_level_record(pair, robot, fine=seconds, infer=0.0, planning=0.0, diagnosis=0.0)
        for robot, seconds in times
        for pair in "pq"
    ]
    return views(records, PAPER)


def test_a_level_has_both_conditions_and_their_ratio_above_the_published() -> None:
    known = _views((ZOOM, 0.05), (NO_ZOOM, 1.0))
    zoom, without = known["levels-seconds"].lines
    assert zoom.labels == ("L3", "zoom", "2")
    assert zoom.values[0] == Value("100.0%", ("15.8", "100.0"), published="100%", inside=True)
    assert zoom.values[2] == Value("50.0 ± 0.0 ms", median="50.0 ms", published="4.19 ± 1.48 s")
    assert without.labels == ("L3", "no zoom", "2")
    assert (without.values[0].published, without.values[0].inside) == ("65%", True)
    assert without.values[4].published == "45.98 ± 43.05 s"
    (ratio,) = known["levels-ratios"].lines
    assert ratio.labels == ("L3", "no zoom / zoom", "2")
    value = ratio.values[1]
    assert (value.whole, value.of_sums) == ("20.00 [20.00, 20.00]", "20.00")
    assert (value.published, value.inside) == ("55.23", False)
    for view in known.values():
        assert {len(line.values) for line in view.lines} == {len(view.columns) - 3}


def test_one_condition_has_no_ratio_and_one_level_no_growth() -> None:
    assert set(_views((ZOOM, 0.05))) == {"levels-seconds"}


def _ratio_colours(paper: Paper, *robots: str) -> list[set[str]]:
    records = [a_level_record("p", robot) for robot in robots]
    drawn = list(ratio_charts(found(records, paper)))
    assert len({chart.name for chart in drawn}) == len(drawn)
    return [{own.colour for own in chart.series} for chart in drawn]


def test_ratios_are_drawn_beside_the_published_ones_where_there_are() -> None:
    assert _ratio_colours(PAPER, ZOOM, NO_ZOOM) == [{"second", "paper"}] * 2
    assert _ratio_colours(OWN, ZOOM, NO_ZOOM) == [{"second"}] * 2
    assert _ratio_colours(PAPER, ZOOM) == []
