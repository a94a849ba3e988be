"""Sweeps: the conditions that they name, what each sets, and mistakes in them."""

from pathlib import Path
from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st

from testbed.config import ConfigError, conditions_of, load_config, with_sweep
from testbed.config.composing import read_yaml
from testbed.config.sweep import Sweep, numbers_of
from tests.greenhouse import WINDY

BASE = """\
name: pots
domain: greenhouse.al
goal: ["stands(fern,sill)"]
adversary: {strategy: random}
"""


def written(folder: Path, sweep: str = "") -> Path:
    """A configuration of the greenhouse with a sweep, beside its domain."""
    (folder / "greenhouse.al").write_text(WINDY, encoding="utf-8")
    path = folder / "pots.yaml"
    path.write_text(BASE + sweep, encoding="utf-8")
    return path


def refused(path: Path, *overrides: str) -> str:
    with pytest.raises(ConfigError) as caught:
        load_config(path, overrides)
    (line,) = caught.value.lines
    return line


def test_everything_is_combined_with_everything() -> None:
    swept = Sweep.model_validate(
        {
            "grid": {"a": [1, 2], "b": "0:0.2:0.1"},
            "zip": [{"c": [True, False], "d": ["x", "y"]}],
            "conditions": {"bare": {}, "full": {"e": {"f": 1}}},
        }
    )
    cells = swept.cells
    assert len(cells) == swept.size == 2 * 3 * 2 * 2
    assert cells["bare, c=true, a=1, b=0.1"] == {"c": True, "d": "x", "a": 1, "b": 0.1}
    assert cells["full, c=false, a=2, b=0.2"]["e"] == {"f": 1}
    assert [axis.name for axis in swept.axes] == ["condition", "c", "a", "b"]


def test_without_a_sweep_there_is_one_condition_that_changes_nothing(tmp_path: Path) -> None:
    config = load_config(written(tmp_path))
    assert conditions_of(config) == {"": config}
    assert not config.is_sweep


@pytest.mark.parametrize(("zipped", "size"), [({}, 2), ([], 2), ([{}, {"b": [3, 4]}], 4)])
def test_a_group_without_keys_takes_nothing_from_the_others(zipped: object, size: int) -> None:
    swept = Sweep.model_validate({"zip": zipped, "grid": {"a": [1, 2]}})
    assert {own["a"] for own in swept.cells.values()} == {1, 2}
    assert swept.size == len(swept.cells) == size


def test_zipped_values_that_a_first_key_does_not_tell_are_named_by_all() -> None:
    (axis,) = Sweep.model_validate({"zip": {"a": [1, 1], "b": [3, 4]}}).axes
    assert list(axis.points) == ["a=1, b=3", "a=1, b=4"]


@given(st.integers(-50, 50), st.integers(1, 40), st.integers(1, 9), st.integers(0, 3))
def test_a_range_has_its_last_number_and_is_exact(
    first: int, steps: int, step: int, digits: int
) -> None:
    def text(number: int) -> str:
        return f"{number / 10**digits:.{digits}f}"

    last = first + steps * step
    numbers = numbers_of(f"{text(first)}:{text(last)}:{text(step)}")
    assert [float(own) for own in numbers] == [
        float(text(first + index * step)) for index in range(steps + 1)
    ]


def test_each_condition_has_its_keys_and_else_those_of_all(tmp_path: Path) -> None:
    sweep = """\
limits: {steps: 12}
sweep:
  grid: {adversary.rate: 0:1:0.5}
  conditions:
    seen: {knowledge: seen, observability: {blow: {mode: always}}}
    hasty: {limits.steps: 3}
"""
    found = conditions_of(load_config(written(tmp_path, sweep)))
    assert len(found) == 6
    seen, hasty = found["seen, adversary.rate=0.5"], found["hasty, adversary.rate=1.0"]
    assert (seen.knowledge, seen.limits.steps, seen.adversary.rate) == ("seen", 12, 0.5)
    assert (hasty.knowledge, hasty.limits.steps, hasty.adversary.rate) == ("complete", 3, 1.0)
    assert seen.observability["blow"].mode == "always"
    assert not hasty.observability
    assert not any(own.is_sweep for own in found.values())
    assert len({(own.domain, own.goal, own.scenarios) for own in found.values()}) == 1


@pytest.mark.parametrize(
    ("sweep", "told"),
    [
        ("{grid: {adversary.rate: [0.5, 2]}}", "adversary.rate=2: adversary.rate: should be"),
        ("{grid: {limits.stps: [1, 2]}}", "did you mean 'steps'?"),
        ("{grid: {observability.blw.mode: [never]}}", "did you mean 'blow'?"),
        ("{grid: {goal.a.b: [1]}}", "goal.a.b=1"),
        ("{grid: {limits.steps: '1:2'}}", "sweep.grid.limits.steps"),
        ("{grid: {limits.steps: '1:2:0'}}", "sweep.grid.limits.steps"),
        ("{grid: {limits.steps: '1:20000:1'}}", "10000"),
        ("{grid: {limits.steps: []}}", "should not be empty"),
        ("{zip: {limits.steps: [1], limits.plan: [1, 2]}}", "limits.plan has 2"),
        ("{grid: {limits.steps: [1]}, zip: {limits.steps: [2]}}", "limits.steps twice"),
        ("{grid: {adversary.rate: [0.5, 0.1, 0.50]}}", "adversary.rate=0.5 2 times"),
        ("{zip: {limits.steps: [7, 7], limits.plan: [2, 2]}}", "limits.steps=7, limits.plan=2 2"),
        ("{grd: {limits.steps: [1]}}", "did you mean 'grid'?"),
        ("{grid: {limits.steps: '1:1000:1', limits.plan: '1:1000:1'}}", "1000000 conditions"),
    ],
)
def test_a_mistake_is_one_line_with_its_place(tmp_path: Path, sweep: str, told: str) -> None:
    path = written(tmp_path, f"sweep: {sweep}\n")
    line = refused(path)
    assert line.startswith(f"{path}:5: sweep")
    assert told in line


@pytest.mark.parametrize(
    "key", ["name", "seed", "robots", "scenarios", "limit", "link", "domain", "draw.holding"]
)
def test_keys_that_make_no_condition_are_not_swept(tmp_path: Path, key: str) -> None:
    assert f"cannot vary {key}" in refused(written(tmp_path, f"sweep: {{grid: {{{key}: [1]}}}}\n"))


@pytest.mark.parametrize(
    ("given_values", "swept"),
    [
        ("0,1", [0, 1]),
        ("0:1:0.5", [0.0, 0.5, 1.0]),
        ("[1],[2,3]", [[1], [2, 3]]),
        ('["f(a,b)"],["f(b,c)","g"]', [["f(a,b)"], ["f(b,c)", "g"]]),
        ("{m: never},{m: always}", [{"m": "never"}, {"m": "always"}]),
        ("'a,b',c", ["a,b", "c"]),
    ],
)
def test_values_of_an_override_are_those_between_its_commas(
    given_values: str, swept: list[Any]
) -> None:
    fixed, sweep = with_sweep([f"k.l={given_values}", "robots=[a,b]"])
    assert fixed == "robots=[a,b]"
    key, _, text = sweep.partition("=")
    assert key == "sweep.grid"
    (found,) = Sweep.model_validate({"grid": read_yaml(text)}).axes
    assert [point["k.l"] for point in found.points.values()] == swept


def test_overrides_of_one_value_are_no_sweep() -> None:
    assert with_sweep(["limit=5", "robots=[a,b]"]) == ["limit=5", "robots=[a,b]"]


def test_an_override_of_what_each_condition_sets_has_no_effect_and_is_refused(
    tmp_path: Path,
) -> None:
    path = written(tmp_path, "sweep: {grid: {adversary.rate: [0.1, 0.2]}}\n")
    line = refused(path, "adversary.rate=0.5")
    assert line.startswith("command line: adversary.rate: ")
    assert "sweep={}" in line
    assert load_config(path, ["sweep={}", "adversary.rate=0.5"]).adversary.rate == 0.5
    some = "sweep: {conditions: {calm: {adversary.rate: 0}, usual: {}}}\n"
    (_, usual) = conditions_of(load_config(written(tmp_path, some), ["adversary.rate=0.5"])).items()
    assert usual[1].adversary.rate == 0.5
