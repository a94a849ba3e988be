"""The tables of the levels, from records made by hand."""

import polars as pl
import pytest

from testbed.analysis.bootstrap import Estimate
from testbed.analysis.table import table_of
from testbed.experiment.record import TrialRecord
from testbed.report.tables import Row, headings
from testbed.report.tables import rows_of as rows_of_run
from testbed.studies import Cell, Rounded, grid, rows_of
from testbed.studies.levels.published import (
    NO_ZOOM,
    OWN,
    PAPER,
    PARTS,
    PUBLISHED,
    RATIOS,
    ZOOM,
    Paper,
)
from testbed.studies.levels.tables import FEW, FEW_PAIRS, effect_rows
from tests.experiment.samples import a_level_record, a_record
from tests.studies.levels.found import found, views

Cells = tuple[str, ...]


def _rows(view: str, records: list[TrialRecord], paper: Paper = PAPER) -> list[Cells]:
    return list(rows_of(views(records, paper)[f"levels-{view}"].lines))


def _both(level: str, number: int = 1, slower: float = 1.0) -> list[TrialRecord]:
    return [
        record
        for index in range(number)
        for record in (
            a_level_record(f"{level}{index}", ZOOM, level=level),
            a_level_record(f"{level}{index}", NO_ZOOM, level=level, fine=0.2 * slower),
        )
    ]


def test_each_condition_has_means_medians_and_the_published_figures() -> None:
    rows = _rows("seconds", _both("L3"))
    assert [row[:3] for row in rows] == [
        ("L3", "zoom", "1"),
        ("L3", "  median", ""),
        ("L3", "  published", ""),
        ("L3", "no zoom", "1"),
        ("L3", "  median", ""),
        ("L3", "  published", ""),
    ]
    assert rows[0][4] == "1.00 ± 0.00 s"
    assert rows[1][4] == "1.00 s"
    assert rows[2][4:] == ("11.59 ± 3.88 s", "4.19 ± 1.48 s", "7.40 ± 2.57 s", "560.0 ± 50.0 ms")


def test_a_goal_out_of_reach_is_told_beside_the_number_of_trials() -> None:
    records = [
        a_level_record("a", ZOOM),
        a_level_record("b", ZOOM, achieved=False, in_reach=False),
        a_level_record("c", ZOOM, achieved=False, in_reach=True),
    ]
    assert _rows("seconds", records)[0][2] == "3, 1 out of reach"


def test_a_share_of_trials_that_ended_alike_has_the_exact_interval() -> None:
    rows = _rows("seconds", _both("L3", 10))
    # Clopper and Pearson: 0.025 ** (1 / 10) = 0.692.
    assert [row[3] for row in rows] == [*["100.0% [69.2, 100.0]", "", "100%"],
                                        *["100.0% [69.2, 100.0]", "", "65% *"]]  # fmt: skip


def test_a_published_ratio_that_our_interval_does_not_hold_is_marked() -> None:
    mean, median, of_sums, published = _rows("ratios", _both("L1", 3))
    assert mean == ("L1", "no zoom / zoom", "3", *["1.00 [1.00, 1.00]"] * 4)
    assert median == ("L1", "  median", "", *["1.00 [1.00, 1.00]"] * 4)
    assert of_sums == ("L1", "  of sums", "", *["1.00"] * 4)
    assert published == ("L1", "  published", "", "1.01 *", "1.02 *", "1.00", "1.03 *")


@pytest.mark.parametrize(("pairs", "few"), [(FEW - 1, True), (FEW, False)])
def test_ratios_of_few_pairs_say_so(pairs: int, few: bool) -> None:
    assert (FEW_PAIRS in views(_both("L1", pairs))["levels-ratios"].title) == few


def test_growth_is_told_of_each_level_but_the_first() -> None:
    rows = _rows("growth", [*_both("L1", 2), *_both("L2", 2, slower=2.0)])
    assert [row[:3] for row in rows[::3]] == [("L2", "zoom", "2"), ("L2", "no zoom", "2")]
    assert rows[3][6] == "2.00 [2.00, 2.00]"
    assert rows[5][3:] == ("1.71 *", "2.77 *", "1.34 *", "2.38 *")


def test_a_published_growth_is_as_exact_as_what_was_rounded_for_it() -> None:
    grown = PAPER.growth("L2", ZOOM, "refined_plan")
    assert grown is not None
    # 0.41 / 0.37 may have been 0.4149 / 0.3651 as well.
    assert grown.value == pytest.approx(1.108, abs=0.001)
    assert grown.value + grown.half_digit == pytest.approx(0.415 / 0.365)
    assert PAPER.growth("L4", NO_ZOOM, "total") is OWN.growth("L2", ZOOM, "total") is None


@pytest.mark.parametrize(
    ("published", "inside"), [(1.29, False), (1.296, True), (1.5, True), (1.71, False)]
)
def test_a_published_value_lies_inside_up_to_its_rounding(published: float, inside: bool) -> None:
    cell = Cell(Estimate(1.5, 1.3, 1.7), published=Rounded(published))
    assert cell.inside is inside
    assert Cell(Estimate(1.5, 1.3, 1.7)).inside is None


def test_a_run_of_ones_own_has_the_same_tables_without_published_figures() -> None:
    records = [*_both("L1", 2), *_both("L3", 2)]
    compared, own = views(records, PAPER), views(records, OWN)
    assert list(own) == list(compared)
    for name, view in own.items():
        assert "  published" in {row[1] for row in rows_of(compared[name].lines)}
        assert "  published" not in {row[1] for row in rows_of(view.lines)}
        assert "published" not in view.columns


def test_the_terminal_has_each_interval_below_its_value() -> None:
    shown = grid(views(_both("L1", FEW), PAPER)["levels-ratios"], "ratios")
    assert shown.title.startswith("ratios (*")
    assert [row[3] for row in shown.rows if row] == ["1.00", "[1.00, 1.00]", "1.00", "1.01 *"]


def test_tests_are_told_where_times_differ() -> None:
    slower = [record for n in range(8) for record in _both("L1", 1, 2.0 + n)]
    for index, record in enumerate(slower):
        record.pair = f"p{index // 2}"
    ((level, pairs, *cells),) = effect_rows(found(slower).levels)
    assert (level, pairs) == ("L1", "8")
    # All eight differences have one sign: 2 / 2 ** 8, of three tests.
    assert cells == ["+1.00 (p = 0.023)", "+1.00 (p = 0.023)", "-", "+1.00 (p = 0.023)", "-", "-"]


def test_totals_of_the_published_figures_are_the_sums_of_their_parts() -> None:
    for (level, condition), figures in PUBLISHED.items():
        if figures.seconds:
            mean = {part: figures.seconds[part][0] for part in PARTS}
            # The published values are rounded to a hundredth each.
            assert mean["fine"] + mean["coarse"] == pytest.approx(mean["total"], abs=0.011), level
        else:
            assert (condition, figures.completed) == (NO_ZOOM, 0.0)
    assert set(RATIOS) == {"L1", "L2", "L3"}


def _trials(record: TrialRecord) -> list[Row]:
    return rows_of_run(table_of([record]), pl.Series("apart", [None], pl.String))


def test_rows_are_by_level() -> None:
    rows = _trials(a_level_record("a", ZOOM))
    assert headings(rows)[0] == "level"
    assert headings(rows)[-2] == "coarse planning"
    assert rows[0].cells()[:2] == ("L3", ZOOM)
    coarse = a_record("a")
    assert headings(_trials(coarse))[0] == "scenario"
    assert headings(_trials(coarse))[-2] == "planning"
    assert found([coarse]).levels == {}
