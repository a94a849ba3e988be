"""The tables of a small run, and its summary: one set of numbers."""

import json
from pathlib import Path
from typing import Any

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from testbed.analysis import load_run
from testbed.analysis.pairs import Compared
from testbed.analysis.table import table_of
from testbed.config import load_config
from testbed.experiment.record import Activity, Attempt, Occurrence, TrialRecord
from testbed.experiment.run_folder import write_config
from testbed.experiment.runner import play_missing
from testbed.experiment.store import read_records
from testbed.report import write_report
from testbed.studies.table1.measures import Analysis, Row, analyse, measures
from testbed.studies.table1.pairs import pairs_in
from testbed.studies.table1.published import ALL, MEASURES, PUBLISHED
from testbed.world import load_world
from tests.experiment.samples import a_record, summary_of

CONFIG = load_config("table1", ["limit=16", "repeats=2", "scenario_settings={}"])
INTENDED = ("1", "2", "3", "4", "5")
WORLD = load_world("office")
SURE = frozenset("2345")
START = ["loc(rob1,kitchen)", "loc(book1,kitchen)", "loc(book2,kitchen)"]


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A run with its report."""
    run = tmp_path_factory.mktemp("numbers")
    write_config(run, CONFIG)
    play_missing(CONFIG, run, 1, lambda _: None)
    write_report(run, CONFIG)
    return run


@pytest.fixture(scope="module")
def summary(folder: Path) -> Any:
    return json.loads((folder / "summary.json").read_text(encoding="utf-8"))


@pytest.fixture(scope="module")
def analysis(folder: Path) -> Analysis:
    (found,) = measures(load_run(folder), as_published=True)
    return found


def _triggered(analysis: Analysis) -> dict[str, Row]:
    return {row.name: row for row in analysis.tables["triggered"].rows}


def test_a_scenario_has_the_numbers_of_its_row(summary: Any, analysis: Analysis) -> None:
    rows = _triggered(analysis)
    for name in INTENDED:
        row, group = rows[name], summary["scenarios"][name]
        assert row.treatment is not None
        assert row.baseline is not None
        assert group["pairs"] == row.pairs
        shares = {"intentional": row.treatment.value, "traditional": row.baseline.value}
        assert group["accuracy"] == pytest.approx(shares)
        test = row.accuracy
        found = group["p_values"]["accuracy"], group["effects"]["accuracy"]
        assert found == ((test.p, test.effect) if test else (None, None))
        assert group["optimum"].keys() == row.optimum.keys()
        for robot, own in row.optimum.items():
            assert group["optimum"][robot] == pytest.approx(own)


def test_what_is_in_no_row_is_counted_apart_in_the_summary(summary: Any, folder: Path) -> None:
    (found,) = measures(load_run(folder), as_published=True)
    apart = {
        reason: sum(summary["scenarios"][name][key] for name in INTENDED)
        for reason, key in (("no event", "without_event"), ("nothing to do", "nothing_to_do"))
    }
    assert dict(found.tables["triggered"].apart) == apart
    assert min(apart.values()) > 0
    pairs = {record.pair for record in read_records(folder) if record.scenario in INTENDED}
    counted = sum(summary["scenarios"][name]["pairs"] for name in INTENDED)
    assert counted + sum(apart.values()) == len(pairs)


def test_the_random_pairs_are_those_of_the_rows_of_the_other_table(
    summary: Any, analysis: Analysis
) -> None:
    pairs = sum(row.pairs for row in analysis.tables["random"].rows if row.name.isdigit())
    assert summary["scenarios"]["random"]["pairs"] == pairs


def test_the_summary_has_both_tables(summary: Any, analysis: Analysis) -> None:
    assert set(summary["table1"]) == {"intentional"}
    tables = summary["table1"]["intentional"]
    assert tables["became"] == analysis.became
    assert set(analysis.tables) == {"triggered", "random"}
    for kind, table in analysis.tables.items():
        assert tables[kind]["apart"] == table.apart
        assert list(tables[kind]["rows"]) == [row.name for row in table.rows]
        for row in table.rows:
            _compare(tables[kind]["rows"][row.name], row)


def _compare(found: Any, row: Row) -> None:
    counts = ("pairs", "out_of_reach", "meetings")
    assert {key: found[key] for key in counts} == {key: getattr(row, key) for key in counts}
    assert {key: found[key] for key in row.left_out} == row.left_out
    for measure, ratio in row.ratios.items():
        own = found["ratios"][measure]
        assert own["pairs"] == ratio.pairs
        for estimate, keys in (
            (ratio.mean, ("mean", "low", "high")),
            (ratio.median, ("median", "median_low", "median_high")),
        ):
            ours = estimate and (estimate.value, estimate.low, estimate.high)
            if estimate and estimate.single:
                ours = (estimate.value, None, None)
            assert tuple(own[key] for key in keys) == (ours or (None, None, None))
        test = ratio.test and (ratio.test.p, ratio.test.holm, ratio.test.effect)
        assert (own["p"], own["holm"], own["effect"]) == (test or (None, None, None))


def test_a_published_value_says_whether_it_lies_in_our_interval(summary: Any) -> None:
    rows = summary["table1"]["intentional"]["triggered"]["rows"]
    for name, paper in PUBLISHED.items():
        for measure in MEASURES:
            own = rows[name]["ratios"][measure]
            assert own["published"] == paper.ratios[measure]
            _inside(own, own["mean"])
        for robot, share in (("traditional", paper.baseline), ("intentional", paper.treatment)):
            own = rows[name]["accuracy"][robot]
            assert own["published"] == share
            _inside(own, own["value"])
    assert "6" not in rows
    six = summary["table1"]["intentional"]["random"]["rows"].get("6")
    assert six is None or six["ratios"]["plans"]["inside"] is None


def _inside(own: Any, value: float | None) -> None:
    """Published values have two decimals; a value of one initial state has no interval."""
    if value is None or own["low"] is None:
        assert own["inside"] is None
    else:
        assert own["inside"] == (own["low"] - 0.005 <= own["published"] <= own["high"] + 0.005)


def test_where_nothing_happens_nobody_needs_more_actions_than_the_fewest(summary: Any) -> None:
    found = summary["table1"]["intentional"]["triggered"]["rows"]
    for robot in ("intentional", "traditional"):
        own = found["1"]["optimum"][robot]
        assert (own["trials"], own["actions"]) == (found["1"]["pairs"], 1.0)
        assert own["execution_units"] >= 1.0
    assert found[ALL]["optimum"]["intentional"]["trials"] == found[ALL]["pairs"]


@st.composite
def _trials(draw: st.DrawFn) -> list[TrialRecord]:
    """A pair of a scenario, of which any trial may fail, be missing, or have nothing to do."""
    common = {
        "pair": draw(st.uuids()).hex,
        "scenario": draw(st.sampled_from(INTENDED)),
        "initial": [*START, *draw(st.sampled_from([[], ["in_hand(rob1,book1)"]]))],
        "minimal_actions": draw(st.sampled_from([None, 3, 3, 3])),
        "minimal_units": 30,
    }
    idle, eventful = draw(st.booleans()), draw(st.booleans())
    records = [
        a_record(
            f"{robot} {common['pair']}",
            **common,
            robot=robot,
            outcome=draw(st.sampled_from(["achieved"] * 4 + ["error"])),
            cause=draw(st.sampled_from(["robot", "infrastructure"])),
            correct=draw(st.booleans()),
            action_count=draw(st.integers(0, 4)),
            plans=draw(st.integers(0, 2)),
            actions=[] if idle else [Attempt(2, "unlock(rob1,library)", False)],
            activities=[] if idle or robot == "traditional" else [Activity(1, 1, ["a"])],
            exogenous=[Occurrence(2, "exo_lock(library)", False)] if eventful else [],
        )
        for robot in ("traditional", "intentional")
    ]
    return records[: draw(st.sampled_from([1, 2, 2, 2]))]


@settings(max_examples=60)
@given(st.lists(_trials(), min_size=1, max_size=12))
def test_whatever_comes_of_pairs_both_count_the_same(trials: list[list[TrialRecord]]) -> None:
    both = [a_record("i", scenario="6"), a_record("t", scenario="6", robot="traditional")]
    records = [*both, *(record for pair in trials for record in pair)]
    summary: Any = summary_of(records, SURE)
    robots = Compared("traditional", "intentional")
    pairs = pairs_in(table_of(records[2:]), WORLD, robots, SURE)
    table = analyse(pairs, robots).tables.get("triggered")
    rows = {} if table is None else {row.name: row for row in table.rows}
    apart = {"no event": 0, "nothing to do": 0} | dict({} if table is None else table.apart)
    groups = {name: own for name, own in summary["scenarios"].items() if name != "6"}
    for name, group in groups.items():
        row = rows.get(name)
        if row is None:
            assert (group["pairs"], group["failed_pairs"], group["unsolvable"]) == (0, 0, 0)
            continue
        counts = (group["pairs"], group["failed_pairs"], group["unsolvable"])
        assert counts == (row.pairs, row.left_out["failed"], row.left_out["unsolvable"])
        shares = (group["accuracy"].get("intentional"), group["accuracy"].get("traditional"))
        assert shares == tuple(own and own.value for own in (row.treatment, row.baseline))
    assert sum(group["without_event"] for group in groups.values()) == apart["no event"]
    assert sum(group["nothing_to_do"] for group in groups.values()) == apart["nothing to do"]
    missing = sum(group["incomplete"] for group in groups.values())
    assert missing == sum(len(pair) == 1 for pair in trials)
