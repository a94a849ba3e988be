"""The packaged studies of sweeps, in a small size: every condition is played, told and drawn."""

import json
from pathlib import Path

import pytest

from testbed.analysis import load_run
from testbed.config import load_config
from testbed.experiment.runner import run
from testbed.report import write_report
from testbed.studies import results_of

SMALL = {
    "attention": ("limit=1",),
    "knowledge": ("repeats=1",),
    "observability": ("limit=1",),
    "rate": ("limit=1",),
}


@pytest.mark.parametrize("name", SMALL)
def test_each_condition_is_in_the_summary_and_in_a_figure(name: str, tmp_path: Path) -> None:
    config = load_config(name, SMALL[name])
    assert run(config, tmp_path, workers=0).exit_code == 0
    write_report(tmp_path, config)
    told = json.loads((tmp_path / "summary.json").read_text(encoding="utf-8"))["conditions"]
    assert list(told) == list(config.sweep.cells)
    (found,) = results_of(load_run(tmp_path))
    (section,) = found.sections
    assert [line.labels[0] for line in section.views[0].lines] == list(told)
    *others, last = config.sweep.axes
    drawn = [chart for chart in section.charts if chart.kind == "share curve"]
    figures = 1
    for axis in others:
        figures *= len(axis.points)
    assert len(drawn) == figures
    assert all(len(chart.places) == len(last.points) for chart in drawn)
    assert 'id="conditions"' in (tmp_path / "report.html").read_text(encoding="utf-8")


def test_the_figure_of_orders_has_a_point_per_order_and_robot(tmp_path: Path) -> None:
    config = load_config("ties", ["limit=1", "sweep.grid.ties=[1,2,3]"])
    assert run(config, tmp_path, workers=0).exit_code == 0
    write_report(tmp_path, config)
    told = json.loads((tmp_path / "summary.json").read_text(encoding="utf-8"))["conditions"]
    assert list(told) == list(config.sweep.cells)
    (found,) = results_of(load_run(tmp_path))
    (section,) = found.sections
    (chart,) = section.charts
    assert list(chart.places) == list(config.robots)
    named = list(config.sweep.conditions)
    assert (
        [series.label for series in chart.series] == named == [key.text for key in section.legend]
    )
    for series in chart.series:
        keys = (f"{series.label}, ties={ties}" for ties in (1, 2, 3))
        shares = [(r, told[key]["achieved"][r]["value"]) for key in keys for r in config.robots]
        assert [(point.place, point.value) for point in series.points] == shares
    assert 'id="conditions"' in (tmp_path / "report.html").read_text(encoding="utf-8")
