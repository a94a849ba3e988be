"""Scenarios of which the whole population is played: no interval, and marks that say `the same`."""

from pathlib import Path

import pytest

from testbed.analysis import load_run
from testbed.config import load_config
from testbed.experiment.run_folder import write_config
from testbed.experiment.runner import play_missing
from testbed.studies.table1.measures import measures
from testbed.studies.table1.tables import cells, lines
from tests.studies.table1.made import a_pair, a_side, analysed

PAIRS = [
    a_pair(scenario, a_side(), a_side(actions=actions), scenario, state=f"s{actions}")
    for scenario in ("1", "4")
    for actions in (1.0, 2.0, 6.0)
]


def test_its_rows_have_no_interval_and_the_others_do() -> None:
    table = analysed(PAIRS, exhaustive=["1"]).tables["triggered"]
    ends = {row.name: row.ratios["actions"].mean.ends for row in table.rows if row.pairs}  # type: ignore[union-attr]
    assert ends.pop("1") == ()
    assert {len(own) for own in ends.values()} == {2}
    assert [row.name for row in table.rows if row.whole] == ["1"]
    sampled = analysed(PAIRS).tables["triggered"]
    assert [row.name for row in sampled.rows if row.whole] == []
    values = [own.rows[0].ratios["actions"].mean for own in (table, sampled)]
    assert values[0].value == values[1].value == 3.0  # type: ignore[union-attr]


def test_a_published_value_is_marked_by_whether_it_is_the_same() -> None:
    """That of actions is 1.00: our 3.00 is another, and an interval from 1 to 6 would have it."""
    whole = analysed(PAIRS, exhaustive=["1"]).tables["triggered"]
    row, sampled = whole.rows[0], analysed(PAIRS).tables["triggered"]
    assert cells(whole, row)["actions"].inside is False
    assert cells(sampled, sampled.rows[0])["actions"].inside is True
    assert cells(whole, row)["plans"].inside is True
    (line, *_) = (own for own in lines(whole) if own.labels[0] == "1")
    assert all(value.ends == () for value in line.values)


def test_pairs_drawn_at_random_are_no_population() -> None:
    drawn = [a_pair("1", state="s1"), a_pair("1", a_side(actions=2.0), state="s2")]
    (row, *_) = analysed(drawn, exhaustive=["1"]).tables["random"].rows
    assert not row.whole
    assert row.ratios["actions"].mean is not None
    assert len(row.ratios["actions"].mean.ends) == 2


@pytest.mark.parametrize(("limit", "whole"), [("limit=null", ["1"]), ("limit=2", [])])
def test_the_study_tells_it_of_a_run(tmp_path: Path, limit: str, whole: list[str]) -> None:
    """Whose trials end with their first step: what counts is which of them there are."""
    config = load_config("table1", ["scenarios=['1']", "link=inprocess", "limits.steps=1", limit])
    write_config(tmp_path, config)
    play_missing(config, tmp_path, 0, lambda _: None)
    (found,) = measures(load_run(tmp_path), as_published=False)
    assert [row.name for row in found.tables["triggered"].rows if row.whole] == whole
