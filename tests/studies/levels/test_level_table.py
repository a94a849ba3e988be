"""The tables of the levels, from records made by hand."""

import pytest

from testbed.analysis.statistics import Estimate
from testbed.analysis.summary import summarise
from testbed.config import load_config
from testbed.experiment.record import TrialRecord
from testbed.report.tables import headings, rows_of
from testbed.studies.levels import comparing
from testbed.studies.levels.protocol import paper_of
from testbed.studies.levels.published import (
    NO_ZOOM,
    OWN,
    PAPER,
    PARTS,
    PUBLISHED,
    RATIOS,
    ZOOM,
    Rounded,
)
from testbed.studies.levels.results import levels_of
from testbed.studies.levels.table import (
    GROWTH,
    SECONDS,
    SHARES,
    effect_rows,
    growth_rows,
    level_grid,
    level_tables,
    ratio_rows,
    seconds_rows,
    share_rows,
)
from tests.experiment.samples import a_level_record, a_record


def _levels(*records: TrialRecord) -> comparing.Levels:
    return levels_of(summarise(records))


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
    rows = list(seconds_rows(_levels(*_both("L3")), PAPER))
    assert [row[:3] for row in rows] == [
        ("L3", "zoom", "1/1"),
        ("L3", "  median", ""),
        ("L3", "  published", ""),
        ("L3", "no zoom", "1/1"),
        ("L3", "  median", ""),
        ("L3", "  published", ""),
    ]
    assert all(len(row) == len(SECONDS) for row in rows)
    assert rows[0][3] == "1.00 ± 0.00 s"
    assert rows[1][3] == "1.00 s"
    assert rows[2][3:] == ("11.59 ± 3.88 s", "4.19 ± 1.48 s", "7.40 ± 2.57 s", "560.0 ± 50.0 ms")


def test_a_goal_out_of_reach_is_told_beside_what_was_achieved() -> None:
    records = [
        a_level_record("a", ZOOM),
        a_level_record("b", ZOOM, achieved=False, in_reach=False),
        a_level_record("c", ZOOM, achieved=False, in_reach=True),
    ]
    assert next(seconds_rows(_levels(*records), PAPER))[2] == "1/3, 1 out of reach"


def test_a_share_of_trials_that_ended_alike_has_the_exact_interval() -> None:
    rows = list(share_rows(_levels(*_both("L3", 10)), PAPER))
    # Clopper and Pearson: 0.025 ** (1 / 10) = 0.692.
    assert rows == [
        ("L3", "zoom", "10", "100.0% [69.2, 100.0]", "100%"),
        ("L3", "no zoom", "10", "100.0% [69.2, 100.0]", "65% *"),
    ]
    assert all(len(row) == len(SHARES) for row in rows)


def test_a_published_ratio_that_our_interval_does_not_hold_is_marked() -> None:
    mean, median, of_sums, published = ratio_rows(_levels(*_both("L1", 3)), PAPER)
    assert mean == ("L1", "no zoom / zoom", "3", *["1.00 [1.00, 1.00]"] * 4)
    assert median == ("L1", "  median", "", *["1.00 [1.00, 1.00]"] * 4)
    assert of_sums == ("L1", "  of sums", "", *["1.00"] * 4)
    assert published == ("L1", "  published", "", "1.01 *", "1.02 *", "1.00", "1.03 *")


@pytest.mark.parametrize(("pairs", "few"), [(19, True), (20, False)])
def test_ratios_of_few_pairs_say_so(pairs: int, few: bool) -> None:
    titles = [table.title for table in level_tables(_levels(*_both("L1", pairs)), PAPER)]
    assert any(comparing.FEW_PAIRS in title for title in titles) == few


def test_growth_is_told_of_each_level_but_the_first() -> None:
    rows = list(growth_rows(_levels(*_both("L1", 2), *_both("L2", 2, slower=2.0)), PAPER))
    assert [row[:3] for row in rows[::3]] == [("L2", "zoom", "2"), ("L2", "no zoom", "2")]
    assert all(len(row) == len(GROWTH) for row in rows)
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
    cell = comparing.Cell(Estimate(1.5, 1.3, 1.7), published=Rounded(published))
    assert cell.inside is inside
    assert comparing.Cell(Estimate(1.5, 1.3, 1.7)).inside is None


def test_a_run_of_ones_own_has_the_same_tables_without_published_figures() -> None:
    levels = _levels(*_both("L1", 2), *_both("L3", 2))
    compared, own = level_tables(levels, PAPER), level_tables(levels, OWN)
    assert [table.title for table in own] == [table.title for table in compared]
    assert any("published" in row[1] for table in compared for row in table.rows)
    assert not any("published" in row[1] for table in own for row in table.rows)
    assert {row[-1] for row in own[1].rows} == {"-"}


def test_the_protocol_is_what_the_published_figures_stand_beside() -> None:
    assert paper_of(load_config("levels")) is PAPER
    assert paper_of(load_config("levels", ["protocol=null"])) is OWN


def test_the_terminal_has_each_interval_below_its_value() -> None:
    (_, _, ratios) = level_tables(_levels(*_both("L1", comparing.FEW)), PAPER)
    shown = level_grid(ratios)
    assert shown.title == "No zoom / zoom, over pairs (*: outside of our interval)"
    assert [row[3] for row in shown.rows if row] == ["1.00", "[1.00, 1.00]", "1.00", "1.01 *"]


def test_tests_are_told_where_times_differ() -> None:
    slower = [record for n in range(8) for record in _both("L1", 1, 2.0 + n)]
    for index, record in enumerate(slower):
        record.pair = f"p{index // 2}"
    ((level, pairs, *cells),) = effect_rows(_levels(*slower))
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


def test_rows_are_by_level_and_a_run_without_levels_has_no_such_table() -> None:
    rows = rows_of([a_level_record("a", ZOOM)])
    assert headings(rows)[0] == "level"
    assert headings(rows)[-2] == "coarse planning"
    assert rows[0].cells()[:2] == ("L3", ZOOM)
    coarse = [a_record("a")]
    assert headings(rows_of(coarse))[0] == "scenario"
    assert headings(rows_of(coarse))[-2] == "planning"
    assert level_tables(_levels(*coarse), PAPER) == []
