"""Published values beside ours, as the report shows them."""

from pathlib import Path

import pytest

from testbed.analysis.statistics import Estimate, Test
from testbed.analysis.summary import summarise
from testbed.config import load_config
from testbed.experiment.resume import RunStatus, play_missing
from testbed.report import level_panels, levels, table1
from testbed.report.figures import Panel
from testbed.studies.levels.published import NO_ZOOM, OWN, PAPER, ZOOM, Paper
from testbed.studies.levels.results import levels_of
from testbed.studies.table1.measures import Analysis, Ratio, Row, Table
from testbed.studies.table1.published import MEASURES, PUBLISHED
from tests.experiment.samples import a_level_record

ALWAYS = Estimate(1.0, 0.98, 1.0)


def _row(name: str, mean: Estimate | None, share: Estimate | None = ALWAYS) -> Row:
    ratio = Ratio(10, mean, mean, Test(0.01, 0.5, 0.02))
    return Row(name, 10, 0, 0, 0, {"same": 10}, share, share, None, dict.fromkeys(MEASURES, ratio))


def _analysis(*rows: Row, apart: dict[str, int] | None = None) -> Analysis:
    return Analysis("intentional", "traditional", Table(rows, apart or {}), None, {})


def _values(row: Row) -> dict[str, table1.Value]:
    (view,) = table1.views(_analysis(row))
    (line,) = view.lines
    return dict(zip(table1.COLUMNS[2:], line.values, strict=True))


def test_ours_stands_with_its_interval_above_what_was_published() -> None:
    value = _values(_row("3", Estimate(1.234, 1.006, 1.999)))["actions"]
    assert value == table1.Value("1.23", "1.01 to 2.00", "1.12", inside=True)


def test_a_published_value_outside_of_our_interval_is_told_apart() -> None:
    low = PUBLISHED["3"].ratios["actions"]
    inside = [_values(_row("3", Estimate(2.0, end, 3.0)))["actions"].inside for end in (low, 1.2)]
    assert inside == [True, False]


def test_shares_are_percents_with_a_decimal_of_ours() -> None:
    row = _row("3", Estimate(1.0, 1.0, 1.0), Estimate(0.663, 0.624, 0.701))
    value = _values(row)["TP correct"]
    assert value == table1.Value("66.3%", "62.4% to 70.1%", "72%", inside=False)


def test_without_a_published_row_there_is_nothing_to_be_inside_of() -> None:
    value = _values(_row("6", Estimate(1.0, 1.0, 1.0)))["plans"]
    assert (value.published, value.inside) == ("", None)


def test_without_a_ratio_there_is_none() -> None:
    value = _values(_row("1", None))["planning time"]
    assert (value.ours, value.inside) == ("-", None)


def test_what_is_in_no_row_is_counted() -> None:
    (view,) = table1.views(_analysis(_row("3", None), apart={"no event": 7}))
    assert view.notes[0] == "In no row: 7 pairs of no event"
    assert view.notes[1].startswith("10 pairs: same event beside the same action")


def test_every_measure_and_both_accuracies_are_drawn_and_published_values_with_them() -> None:
    panels = table1.panels(_analysis(_row("3", Estimate(1.2, 1.1, 1.3))))
    assert len(panels) == len(MEASURES) + 2
    assert len({panel.name for panel in panels}) == len(panels)
    for panel in panels:
        assert "var(--paper)" in panel.svg
        assert "var(--first)" in panel.svg


@pytest.fixture(scope="module")
def small(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A run of the comparison that ends after one pair."""
    folder = tmp_path_factory.mktemp("table1")
    play_missing(load_config("table1", ["limit=1", "scenarios=[1]"]), folder, 1, _ignore)
    return folder


def _ignore(tally: RunStatus) -> None:
    del tally


def test_only_the_protocol_has_the_table(small: Path) -> None:
    (analysis,) = table1.analyses(small, load_config("table1"))
    assert analysis.triggered is not None
    assert table1.analyses(small, load_config("office")) == []


def _views(*times: tuple[str, float]) -> dict[str, levels.View]:
    records = [
        a_level_record(pair, robot, fine=seconds, infer=0.0, planning=0.0, diagnosis=0.0)
        for robot, seconds in times
        for pair in "pq"
    ]
    return {view.name: view for view in levels.views(levels_of(summarise(records)), PAPER)}


def test_a_level_has_both_conditions_and_their_ratio_above_the_published() -> None:
    views = _views((ZOOM, 0.05), (NO_ZOOM, 1.0))
    zoom, without = views["levels-seconds"].lines
    assert (zoom.level, zoom.reasoning, zoom.number, zoom.first) == ("L3", "zoom", "2", True)
    assert zoom.values[0] == levels.Value("100.0%", "15.8% to 100.0%", "", "100%", True)
    assert zoom.values[2] == levels.Value(
        "50.0 ± 0.0 ms", median="50.0 ms", published="4.19 ± 1.48 s"
    )
    assert (without.reasoning, without.first) == ("no zoom", False)
    assert (without.values[0].published, without.values[0].inside) == ("65%", True)
    assert without.values[4].published == "45.98 ± 43.05 s"
    (ratio,) = views["levels-ratios"].lines
    assert (ratio.reasoning, ratio.number) == ("no zoom / zoom", "2")
    assert ratio.values[1] == levels.Value("20.00", "20.00 to 20.00", "20.00", "55.23", False)
    for view in views.values():
        assert {len(line.values) for line in view.lines} == {len(view.columns) - 3}


def test_one_condition_has_no_ratio_and_one_level_no_growth() -> None:
    assert set(_views((ZOOM, 0.05))) == {"levels-seconds"}


def _ratio_figures(paper: Paper, *robots: str) -> list[Panel]:
    records = [a_level_record("p", robot) for robot in robots]
    return level_panels.ratio_panels(levels_of(summarise(records)), paper)


def test_ratios_are_drawn_beside_the_published_ones_where_there_are() -> None:
    for paper, drawn in ((PAPER, True), (OWN, False)):
        panels = _ratio_figures(paper, ZOOM, NO_ZOOM)
        assert len({panel.name for panel in panels}) == len(panels) == 2
        assert all(("var(--paper)" in panel.svg) is drawn for panel in panels)
    assert _ratio_figures(PAPER, ZOOM) == []
