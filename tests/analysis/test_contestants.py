"""Any two robots, conditions or runs compared, against what is counted by hand."""

import shutil
from collections.abc import Callable
from pathlib import Path

import pytest
from typer.testing import CliRunner

from testbed.analysis import load_run
from testbed.analysis.contestants import ALL, CONDITIONS, Contrast, contrasts
from testbed.analysis.statistics import holm
from testbed.cli import app
from testbed.config import load_config
from testbed.experiment import StoreError
from testbed.experiment.record import TrialRecord
from testbed.experiment.runner import run
from tests.config.test_sweep import written

CONFIG = """\
link: inprocess
seed: 3
limit: 9
limits: {steps: 8}
"""
SWEPT = "sweep: {grid: {adversary.rate: [0.2, 0.9]}}\n"
GOAL = 'goal=["stands(fern,sill)", "stands(rose,floor)"]'
Which = Callable[[TrialRecord], bool]


def played(folder: Path, name: str, text: str, *overrides: str) -> Path:
    """The folder of a run of the greenhouse."""
    run(load_config(written(folder, text), [GOAL, *overrides]), folder / name, workers=0)
    return folder / name


@pytest.fixture(scope="module")
def swept(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return played(tmp_path_factory.mktemp("swept"), "gusts", CONFIG + SWEPT)


def _by_start(folder: Path, which: Which) -> dict[tuple[object, ...], TrialRecord]:
    records = (own for own in load_run(folder).records() if which(own))
    return {(own.scenario, own.seed, *own.initial, *own.goal): own for own in records}


def _holds(
    found: Contrast,
    base: dict[tuple[object, ...], TrialRecord],
    own: dict[tuple[object, ...], TrialRecord],
) -> None:
    """The comparison is that of these trials, of which those with nothing to do do not count."""
    starts = [start for start in base if own[start].steps > 1]
    assert found.pairs == len(starts) > 1
    assert found.baseline is not None
    assert found.treatment is not None
    share = sum(base[start].achieved for start in starts) / len(starts)
    assert found.baseline.value == pytest.approx(share)
    share = sum(own[start].achieved for start in starts) / len(starts)
    assert found.treatment.value == pytest.approx(share)
    both = [start for start in starts if base[start].achieved and own[start].achieved]
    ratios = [base[start].action_count / own[start].action_count for start in both]
    ratio = found.ratios["actions"].mean
    assert ratio is not None
    assert ratio.value == pytest.approx(sum(ratios) / len(ratios))


def test_robots_are_compared_under_each_condition_and_over_all(swept: Path) -> None:
    found = contrasts([load_run(swept)])
    assert len(found) == 3
    for own, rate in zip(found, (0.2, 0.9), strict=False):
        cell = f"adversary.rate={rate}"
        assert own.robots == (f"{cell} / traditional", f"{cell} / intentional")
        _holds(
            own,
            _by_start(swept, lambda r, c=cell: r.cell == c and r.robot == "traditional"),  # type: ignore[misc]
            _by_start(swept, lambda r, c=cell: r.cell == c and r.robot == "intentional"),  # type: ignore[misc]
        )
    assert found[-1].place == CONDITIONS
    assert found[-1].pairs == found[0].pairs + found[1].pairs


def test_a_robot_is_compared_with_itself_under_another_condition(swept: Path) -> None:
    names = "adversary.rate=0.2 / traditional", "adversary.rate=0.9 / traditional"
    (found,) = contrasts([load_run(swept)], *names)
    cells = [name.partition(" / ")[0] for name in names]
    trials = [
        _by_start(swept, lambda r, c=cell: r.cell == c and r.robot == "traditional")  # type: ignore[misc]
        for cell in cells
    ]
    _holds(found, *trials)
    assert found.baseline != found.treatment


def test_robots_of_two_runs_are_compared_with_themselves(tmp_path: Path) -> None:
    first = played(tmp_path, "calmer", CONFIG, "adversary.rate=0.2")
    second = played(tmp_path, "windier", CONFIG, "adversary.rate=0.9")
    found = contrasts([load_run(first), load_run(second)])
    assert {own.robots for own in found} == {
        (f"calmer / {robot}", f"windier / {robot}") for robot in ("intentional", "traditional")
    }
    for own in found:
        robot = own.robots.baseline.rpartition(" / ")[2]
        both = (_by_start(each, lambda r, n=robot: r.robot == n) for each in (first, second))  # type: ignore[misc]
        _holds(own, *both)


def test_all_tests_are_corrected_together(swept: Path) -> None:
    tests = [
        test
        for own in contrasts([load_run(swept)])
        for test in (own.test, *(ratio.test for ratio in own.ratios.values()))
        if test is not None
    ]
    assert len(tests) > 3
    assert [test.holm for test in tests] == pytest.approx(holm([test.p for test in tests]))


def test_several_scenarios_are_told_apart_and_together(tmp_path: Path) -> None:
    folder = played(tmp_path, "both", CONFIG, "adversary.strategy=triggers")
    found = contrasts([load_run(folder)])
    assert [own.place for own in found] == ["calm", "windy", ALL]
    assert found[-1].pairs == found[0].pairs + found[1].pairs


def test_what_cannot_be_compared_is_said_in_one_line(swept: Path, tmp_path: Path) -> None:
    with pytest.raises(StoreError, match=r"did you mean 'adversary\.rate=0\.2 / traditional'"):
        contrasts([load_run(swept)], "adversary.rate=0.2 / traditiona")
    alone = played(tmp_path, "alone", CONFIG, "robots=[traditional]", "limit=1")
    for folders in (
        [alone],
        [alone, played(tmp_path, "other", CONFIG, "robots=[intentional]", "limit=1")],
    ):
        done = CliRunner().invoke(app, ["compare", *map(str, folders)])
        assert (done.exit_code, done.stderr.count("\n")) == (2, 1)
        assert "--baseline" in done.stderr


def test_the_command_shows_every_comparison(swept: Path) -> None:
    done = CliRunner(env={"COLUMNS": "300"}).invoke(app, ["compare", str(swept)])
    assert done.exit_code == 0
    assert len(done.output.splitlines()) == 1 + 3


def _shown(*arguments: str | Path) -> list[str]:
    """The lines of a comparison below its heads."""
    asked = ["compare", *map(str, arguments)]
    done = CliRunner(env={"COLUMNS": "300"}).invoke(app, asked)
    assert done.exit_code == 0, done.output
    return done.output.splitlines()[1:]


def test_a_condition_of_both_is_named_once(swept: Path, tmp_path: Path) -> None:
    cells = [f"adversary.rate={rate}" for rate in (0.2, 0.9)]
    of_robots = _shown(swept)
    assert [[line.count(cell) for cell in cells] for line in of_robots] == [[1, 0], [0, 1], [0, 0]]
    assert all(line.startswith("intentional against traditional ") for line in of_robots)
    copy = shutil.copytree(swept, tmp_path / "again")
    of_runs = _shown(swept, copy)
    assert [sum(line.count(cell) for cell in cells) for line in of_runs] == [1] * len(of_runs)
    assert "again / traditional against gusts / traditional" in "".join(of_runs)
    names = [f"{cell} / traditional" for cell in cells]
    (line,) = _shown(swept, "--baseline", names[0], "--treatment", names[1])
    assert line.startswith(f"{names[1]} against {names[0]} ")
    assert [line.count(cell) for cell in cells] == [1, 1]


def test_a_condition_without_trials_is_named_once_as_well(swept: Path, tmp_path: Path) -> None:
    begun = shutil.copytree(swept, tmp_path / "begun")
    lines = (begun / "trials.jsonl").read_text("utf-8").splitlines(keepends=True)
    kept = [line for line in lines if '"cell":"adversary.rate=0.2"' in line]
    (begun / "trials.jsonl").write_text("".join(kept), encoding="utf-8")
    assert [line.count("adversary.rate=0.9") for line in _shown(begun)] == [0, 1, 0]


def test_runs_in_folders_of_one_name_are_told_apart(swept: Path, tmp_path: Path) -> None:
    """Each trial of the one is a pair with one of the other, and with no more."""
    copy = shutil.copytree(swept, tmp_path / swept.name)
    alone = [own for own in contrasts([load_run(swept)]) if own.place != CONDITIONS]
    found = contrasts([load_run(swept), load_run(copy)])
    assert {own.pairs for own in found} == {own.pairs for own in alone}
    assert all(str(swept) in own.robots.baseline for own in found)
    assert all(str(copy) in own.robots.treatment for own in found)
    with pytest.raises(StoreError, match="twice"):
        contrasts([load_run(swept), load_run(swept)])
