"""The plan of a sweep: which trials are played first, and what the others are estimated to take."""

from collections.abc import Iterator
from itertools import chain
from pathlib import Path

import pytest

from testbed.config import load_config
from testbed.experiment.pilot import MOST, Pilot
from testbed.experiment.plan import plan_trials
from testbed.experiment.progress import Lines
from testbed.experiment.recorder import Recorder, Result
from testbed.experiment.runner import play_missing
from testbed.experiment.specs import TrialSpec
from testbed.experiment.status import Estimate, RunStatus
from testbed.experiment.store import read_records
from tests.config.test_sweep import written

SWEEP = """\
link: inprocess
seed: 7
limit: 3
sweep:
  grid: {adversary.rate: [0, 0.5, 1]}
"""


def _specs(folder: Path, text: str = SWEEP, *overrides: str) -> list[TrialSpec]:
    return plan_trials(load_config(written(folder, text), list(overrides)))


def _results(specs: list[TrialSpec], seconds: dict[str, float]) -> Iterator[tuple[int, Result]]:
    """A result of each trial that took as long as its condition says, 9 s of them to prepare."""
    for position, spec in enumerate(specs):
        record = Recorder(spec).record
        record.wall_time_s, record.preparation_cpu_s = seconds[spec.cell] + 9.0, 9.0
        yield position, Result(record)


def test_a_pair_of_each_condition_is_played_first_and_all_are_played_once(tmp_path: Path) -> None:
    specs = _specs(tmp_path)
    order = Pilot(specs).order
    cells = list(dict.fromkeys(spec.cell for spec in specs))
    first = [[spec for spec in specs if spec.cell == cell][:2] for cell in cells]
    ahead = list(chain.from_iterable(first))
    assert order == [*ahead, *(spec for spec in specs if spec not in ahead)]


def test_of_many_conditions_pairs_are_spread_evenly(tmp_path: Path) -> None:
    rates = "sweep.grid={adversary.rate: '0:0.99:0.01'}"
    specs = _specs(tmp_path, SWEEP, rates, "limit=1")
    cells = [spec.cell for spec in specs[::2]]
    order = Pilot(specs).order
    assert [spec.cell for spec in order[:40:2]] == cells[::5]
    assert order[40:] == [spec for spec in specs if spec not in order[:40]]
    assert len(cells[::5]) <= MOST


def test_the_estimate_is_what_the_first_pair_takes_times_the_trials(tmp_path: Path) -> None:
    specs = _specs(tmp_path)
    pilot = Pilot(specs)
    cells = list(dict.fromkeys(spec.cell for spec in specs))
    seconds = dict(zip(cells, (1.0, 2.0, 5.0), strict=True))
    played = pilot.results(_results(pilot.order, seconds))  # type: ignore[arg-type]
    for number in range(6):
        assert pilot.estimates == tuple(Estimate(cell, 6, None) for cell in cells), number
        position, result = next(played)
        assert result.record.trial == pilot.order[position].trial
    expected = tuple(Estimate(cell, 6, pytest.approx(6 * seconds[cell])) for cell in cells)
    assert pilot.estimates == expected
    assert [position for position, _ in played] == list(range(6, len(specs)))
    assert pilot.estimates == expected


@pytest.mark.parametrize("workers", [0, 2])
def test_records_stand_in_the_order_in_which_trials_are_played(
    tmp_path: Path, workers: int
) -> None:
    """So that none waits in memory for those of other conditions."""
    config = load_config(written(tmp_path, SWEEP))
    (tmp_path / "run").mkdir()
    told: list[tuple[Estimate, ...]] = []
    status = play_missing(config, tmp_path / "run", workers, lambda run: told.append(run.estimates))
    order = [spec.trial for spec in Pilot(plan_trials(config)).order]
    assert [own.trial for own in read_records(tmp_path / "run")] == order
    assert [own.seconds for own in told[0]] == [None] * 3
    assert all(own.seconds is not None for own in status.estimates)


def test_each_condition_is_listed_with_its_trials_and_time() -> None:
    said: list[str] = []
    lines = Lines(said.append)
    status = RunStatus(500, 0, 0, workers=2)
    status.estimates = (Estimate("one", 123, None), Estimate("two", 377, None))
    lines.notify(status)
    assert len(said) == 1
    assert "500" in said[0]
    status.estimates = (Estimate("one", 123, 60.0), Estimate("two", 377, 14640.0))
    for _ in range(3):
        lines.notify(status)
    listed = [line.split() for line in said[-3:]]
    assert listed == [
        ["one", "123", "0:00:30"],
        ["two", "377", "2:02:00"],
        ["all", "500", "2:02:30"],
    ]


def test_of_many_conditions_some_are_listed_and_all_are_summed() -> None:
    said: list[str] = []
    status = RunStatus(200, 0, 0)
    status.estimates = tuple(Estimate(f"c{n}", 2, 1.0) for n in range(100))
    Lines(said.append).notify(status)
    assert said[-1].split() == ["all", "200", "0:01:40"]
    assert "60" in said[-2]
