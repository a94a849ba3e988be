"""Figures as SVG inside of a page: whole, of the page's colours, and with ids of their own."""

import re
from typing import Literal
from xml.etree import ElementTree

import pytest

from testbed.report.figures import VARIABLES, Panel, drawn
from testbed.studies import Chart, Point, Series

OURS = Series("ours", "first", (Point("a", 2.0, 1.5, 2.5), Point("b", 0.5, 0.4, 0.6)))
THEIRS = Series("theirs", "paper", (Point("a", 1.0),), marker="D", published=True)


def _ratios(name: str = "ratios", *series: Series) -> Panel:
    return drawn(Chart(name, "actions", ["a", "b"], series or (OURS, THEIRS)))


def _texts(panel: Panel) -> list[str]:
    tree = ElementTree.fromstring(str(panel.svg))
    return [text for element in tree.iter("text") if (text := (element.text or "").strip())]


def test_a_figure_is_well_formed_and_needs_nothing_from_elsewhere() -> None:
    svg = str(_ratios().svg)
    assert ElementTree.fromstring(svg).tag == "svg"
    for foreign in ("http", "url(", "<style", "<?xml", "<!--", "xlink", "font-family"):
        assert foreign not in svg


def test_its_colours_are_those_of_the_page() -> None:
    svg = str(_ratios().svg)
    assert "var(--first)" in svg
    assert "var(--paper)" in svg
    assert not any(colour in svg for colour in VARIABLES)
    assert re.findall(r"#[0-9a-f]{6}\b", svg) == []


def test_rows_are_named_and_ratios_have_a_scale() -> None:
    texts = _texts(_ratios())
    assert texts[-2:] == ["a", "b"]
    assert {"0.5", "1", "2"} <= set(texts)


def test_a_share_goes_from_none_to_all() -> None:
    shares = Series("ours", "first", (Point("a", 0.7, 0.6, 0.8),))
    assert "100 %" in _texts(drawn(Chart("shares", "correct", ["a"], [shares], "shares")))


def test_what_is_larger_lies_further_right_and_an_interval_around_its_value() -> None:
    values = (Point("a", 2.0, 1.0, 4.0),)
    larger = _ratios("one", Series("x", "second", values))
    smaller = _ratios("one", Series("x", "second", (Point("a", 1.0, 0.5, 4.0),)))
    (low, high), (least, _) = _interval(larger), _interval(smaller)
    assert low < _marker(larger) < high
    assert abs((low + high) / 2 - _marker(larger)) < 0.5
    assert least < low


def _interval(panel: Panel) -> tuple[float, float]:
    ends = re.findall(
        r'd="M ([\d.]+) [\d.]+ L ([\d.]+) [\d.]+ "[^>]*stroke: var\(--second\)', _flat(panel)
    )
    return float(ends[0][0]), float(ends[0][1])


def _marker(panel: Panel) -> float:
    return float(re.findall(r'<use [^>]*x="([\d.]+)"[^>]*fill: var\(--second\)', _flat(panel))[0])


def _flat(panel: Panel) -> str:
    return str(panel.svg).replace("\n", "")


def test_ids_of_figures_on_one_page_do_not_meet() -> None:
    ids = [set(re.findall(r'id="([^"]+)"', str(_ratios(name).svg))) for name in ("x", "y")]
    assert ids[0]
    assert not ids[0] & ids[1]
    for name in ("x", "y"):
        svg = str(_ratios(name).svg)
        assert set(re.findall(r'href="#([^"]+)"', svg)) == set(re.findall(r'id="([^"]+)"', svg))


def test_the_same_values_give_the_same_figure() -> None:
    assert _ratios().svg == _ratios().svg


def test_times_are_in_seconds_or_less_on_a_log_scale() -> None:
    ours = Series("zoom", "first", (Point("L1", 0.02, 0.01, 0.03), Point("L2", 2.0, 1.0, 3.0)))
    panel = drawn(Chart("levels", "all", ["L1", "L2"], [ours], "seconds"))
    assert {"L1", "L2", "100 ms", "1 s"} <= set(_texts(panel))
    assert "zoom" in str(panel.svg).partition(">")[0]


def test_a_published_curve_is_dashed() -> None:
    published = Series("paper", "second", (Point("L1", 1.0), Point("L2", 2.0)), published=True)
    measured = Series("ours", "second", published.points)
    dashed = [
        "stroke-dasharray" in str(drawn(Chart("x", "all", ["L1", "L2"], [series], "seconds")).svg)
        for series in (published, measured)
    ]
    assert dashed == [True, False]


@pytest.mark.filterwarnings("error")
@pytest.mark.parametrize("kind", ["ratios", "seconds"])
def test_a_value_of_zero_has_no_place_on_a_log_scale(kind: Literal["ratios", "seconds"]) -> None:
    """A robot that made no step, for one; the values beside it are drawn as without it."""
    values = Series("ours", "first", (Point("a", 0.0, 0.0, 0.0), Point("b", 15.0, 14.0, 16.0)))
    assert {"a", "b"} <= set(_texts(drawn(Chart("x", "steps", ["a", "b"], [values], kind))))


def test_what_a_figure_says_of_itself_is_escaped() -> None:
    series = Series("o", "first", (Point("a", 1.0),))
    panel = drawn(Chart("x", 'a "<b>"', ["a"], [series]))
    assert "a &#34;&lt;b&gt;&#34;" in str(panel.svg).partition("\n")[0]
