"""Random events at the coarse resolution, in a domain with scenarios and in one without."""

from pathlib import Path

import pytest

from testbed.cli import app
from testbed.config import load_config
from testbed.experiment.plan import plan_trials
from testbed.experiment.record import TrialRecord
from testbed.experiment.store import read_records
from tests.greenhouse import GREENHOUSE, WINDY

TEXT = """\
name: pots
domain: pots.al
goal: ["stands(fern,sill)", "stands(rose,sill)"]
initial: ["stands(fern,bench)", "stands(rose,floor)"]
robots: [intentional, traditional]
link: inprocess
repeats: 3
adversary: {strategy: random, rate: 0.5}
"""


def _run(folder: Path, *overrides: str) -> list[TrialRecord]:
    arguments = ["run", str(folder / "pots.yaml"), *overrides, "--out", str(folder / "run")]
    with pytest.raises(SystemExit) as ended:
        app([*arguments, "--quiet", "--workers", "1"])
    assert ended.value.code == 0
    return list(read_records(folder / "run"))


@pytest.mark.parametrize(
    ("domain", "overrides", "scenario"),
    [
        (GREENHOUSE, [], "random"),
        (GREENHOUSE, ["scenarios=none"], "none"),
        (WINDY, ["scenarios=[calm]"], "calm"),
    ],
)
def test_random_events_happen_in_every_domain(
    tmp_path: Path, domain: str, overrides: list[str], scenario: str
) -> None:
    (tmp_path / "pots.al").write_text(domain, encoding="utf-8")
    (tmp_path / "pots.yaml").write_text(TEXT, encoding="utf-8")
    records = _run(tmp_path, *overrides)
    assert {record.scenario for record in records} == {scenario}
    assert len(records) == 6
    assert not [record.reason for record in records if record.outcome in ("error", "robot_lost")]
    events = [event for record in records for event in record.exogenous]
    assert {event.action.partition("(")[0] for event in events} == {"blow"}


def test_a_script_and_a_rate_of_zero_leave_nothing_to_chance(tmp_path: Path) -> None:
    (tmp_path / "pots.al").write_text(GREENHOUSE, encoding="utf-8")
    (tmp_path / "pots.yaml").write_text(TEXT, encoding="utf-8")
    for override in ("adversary.rate=0", "script=[]"):
        config = load_config(tmp_path / "pots.yaml", [override])
        assert len(plan_trials(config)) == 2  # one pair: repeats would be equal
    records = _run(tmp_path, "adversary.rate=0")
    assert not any(record.exogenous for record in records)


def test_without_a_rate_random_events_happen_now_and_then(tmp_path: Path) -> None:
    (tmp_path / "pots.al").write_text(GREENHOUSE, encoding="utf-8")
    (tmp_path / "pots.yaml").write_text(TEXT, encoding="utf-8")
    records = _run(tmp_path, "adversary.rate=null", "repeats=30", "robots=[traditional]")
    events = sum(len(record.exogenous) for record in records)
    assert 0 < events < sum(len(record.actions) for record in records) / 2
