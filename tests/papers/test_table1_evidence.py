"""What is concluded from the published rows, checked by hand."""

import pytest

from papers.table1.evidence import closeness, published_failures, published_weights
from testbed.analysis.bootstrap import Estimate
from testbed.analysis.pairs import Ratio
from testbed.studies.table1.measures import Row, Table
from testbed.studies.table1.published import ALL, MEASURES, PUBLISHED, SCENARIOS


def test_the_published_rows_weighted_so_give_the_row_of_all() -> None:
    weights, misfit = published_weights()
    assert sum(weights.values()) == pytest.approx(1.0)
    assert min(weights.values()) >= 0.0
    for measure in MEASURES:
        mean = sum(weights[name] * PUBLISHED[name].ratios[measure] for name in SCENARIOS)
        assert mean == pytest.approx(PUBLISHED[ALL].ratios[measure], abs=misfit + 1e-3)
    assert misfit < 0.005


def test_the_published_failures_and_the_others_make_the_row() -> None:
    for name in ("3", "4"):
        row, rest = PUBLISHED[name], PUBLISHED[f"{name}, no failures"]
        for measure, value in published_failures(name).items():
            whole = (1 - row.baseline) * value + row.baseline * rest.ratios[measure]
            assert whole == pytest.approx(row.ratios[measure])


def _row(name: str, factor: float) -> Row:
    paper = PUBLISHED[name]
    ratios = {
        m: Ratio(9, Estimate(factor * v, factor * v, factor * v), None, None)
        for m, v in paper.ratios.items()
    }
    right = Estimate(paper.baseline, paper.baseline, paper.baseline)
    return Row(name, 9, right, right, None, ratios)


def test_closeness_counts_what_is_inside_and_measures_how_far_off_the_rest_is() -> None:
    equal = closeness(Table(tuple(_row(name, 1.0) for name in SCENARIOS), {}))
    assert (equal.inside, equal.values, equal.distance) == (20, 20, 0.0)
    double = closeness(Table((_row("3", 2.0), _row(ALL, 1.0)), {}))
    assert (double.inside, double.values) == (1, 4)
    assert double.distance == pytest.approx(0.6931, abs=1e-4)
