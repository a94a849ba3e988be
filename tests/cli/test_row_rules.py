"""A row is held to the rules of configurations: what none allows is not played."""

import json
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest
from typer.testing import CliRunner, Result

from benchmarks.own import Own
from testbed.cli import app
from testbed.config import config_names, load_config
from testbed.experiment.plan import plan_trials
from testbed.experiment.recorder import blank_record
from testbed.experiment.rows import trial_of
from testbed.experiment.runner import run
from tests.experiment.gardens import GARDEN, ROWS
from tests.greenhouse import GREENHOUSE

POTS = {
    "goal": ["stands(fern,sill)", "stands(rose,bench)"],
    "initial": ["stands(fern,bench)", "stands(rose,floor)"],
    "script": [{"step": 3, "action": "blow(fern,floor)"}],
    "scenarios": "none",
    "robots": ["intentional"],
}
BEDS = {"goal": ["stands(spade,south)", "-carries(tom,spade)"], "robots": ["intentional"]}
MADE = {"levels": ["L1"], "limit": 1, "robots": ["intentional"]}
Row = dict[str, Any]


def _rows(folder: Path, config: Path) -> Row:
    run(load_config(config, ["link=inprocess"]), folder / "run", workers=0)
    (record,) = map(json.loads, (folder / "run" / "trials.jsonl").read_text("utf-8").splitlines())
    del record["crc32"]
    texts = {"domain": folder / "run" / "own.al", "refinement": folder / "run" / "own.fine"}
    known = {key: own.read_text("utf-8") for key, own in texts.items() if own.is_file()}
    return record | {"texts": known}


@pytest.fixture(scope="module")
def rows(tmp_path_factory: pytest.TempPathFactory) -> dict[str, Row]:
    """A trial at the coarse resolution, one in a map, and one at a level that is made."""
    made = tmp_path_factory.mktemp("made")
    (made / "made.yaml").write_text(json.dumps({"name": "made", **MADE}), encoding="utf-8")
    pots, beds = (tmp_path_factory.mktemp(name) for name in ("pots", "beds"))
    return {
        "pots": _rows(pots, Own(pots, GREENHOUSE).write(**POTS)),
        "beds": _rows(beds, Own(beds, GARDEN.replace("OTHER", "rake"), ROWS).write(**BEDS)),
        "made": _rows(made, made / "made.yaml"),
    }


def _replayed(folder: Path, row: Row) -> Result:
    (folder / "row.json").write_text(json.dumps(row), encoding="utf-8")
    return CliRunner().invoke(app, ["replay", str(folder / "row.json")])


def _condition(**values: object) -> Callable[[Row], Row]:
    return lambda row: row | {"condition": row["condition"] | values}


def _fine(**values: object) -> Callable[[Row], Row]:
    return lambda row: _condition(fine=row["condition"]["fine"] | values)(row)


def _blown(**values: object) -> Callable[[Row], Row]:
    return _condition(observability={"blow": {"mode": "always", **values}})


WRONG: list[tuple[str, str, Callable[[Row], Row]]] = [
    ("pots", "condition.rate", _condition(script=None, strategy="random", rate=7.0)),
    ("pots", "condition.strategy", _condition(script=None, strategy="nobody_has_it:Others")),
    ("pots", "condition.options.no", _condition(strategy="random", options={"no": 1})),
    ("pots", "condition.budget", _condition(budget=-1)),
    ("pots", "condition.cooldown", _condition(cooldown=-2)),
    ("pots", "condition.cost", _condition(cost=-0.5)),
    ("pots", "condition.per_object.shed", _condition(per_object={"shed": 1})),
    ("pots", "condition.events[0]", _condition(events=["bloom"])),
    ("pots", "condition.observability.blow.probability", _blown(probability=-1.0)),
    ("pots", "condition.observability.blow.false_reports", _blown(false_reports=2.0)),
    ("pots", "condition.observability.blow.delay", _blown(delay=-3)),
    ("pots", "condition.observability.bloom", _condition(observability={"bloom": {}})),
    ("pots", "condition.step_limit", _condition(step_limit=-1)),
    ("pots", "condition.plan_limit", _condition(plan_limit=0)),
    ("pots", "condition.conflicts", _condition(conflicts=-5)),
    ("pots", "condition.decision_s", _condition(decision_s=-0.5)),
    ("pots", "condition.judge_states", _condition(judge_states=0)),
    ("pots", "condition.ties", _condition(ties=-1)),
    ("pots", "condition.goal[0]", _condition(goal=["stands(oak,sill)"])),
    ("pots", "condition.goal", _condition(goal=[])),
    ("pots", "condition.script[0][0]", _condition(script=[[0, "blow(fern,floor)"]])),
    ("pots", "condition.script[0][1]", _condition(script=[[3, "blow(oak,floor)"]])),
    (
        "pots",
        "condition.script_at_actions[1][0]",
        _condition(script_at_actions=[[1, "blow(fern,sill)"], [-2, "blow(fern,bench)"]]),
    ),
    ("pots", "initial[0]", lambda row: row | {"initial": ["stands(oak,floor)"]}),
    ("pots", "scenario", lambda row: _condition(script=None)(row) | {"scenario": "storm"}),
    ("beds", "condition.goal", _condition(goal=[])),
    ("beds", "condition.fine.statistics.walk", _fine(statistics={"walk": -0.5})),
    ("beds", "condition.fine.refinement", _fine(size=None, refinement=None)),
    ("made", "condition.fine.statistics.fly", _fine(statistics={"fly": 0.5})),
    (
        "made",
        "condition.fine.size",
        _fine(size={"rooms": 40_000, "rows": 9, "columns": 9, "objects": [[1, 1]]}),
    ),
]


@pytest.mark.parametrize(("of", "key", "change"), WRONG)
def test_what_no_configuration_allows_is_refused_by_its_key(
    of: str, key: str, change: Callable[[Row], Row], rows: dict[str, Row], tmp_path: Path
) -> None:
    refused = _replayed(tmp_path, change(rows[of]))
    assert refused.exit_code == 2, refused.output
    (line,) = refused.stderr.splitlines()
    assert line.startswith(f"{tmp_path / 'row.json'}: {key}: ")
    assert refused.stdout == ""


def test_what_is_within_the_rules_is_played(rows: dict[str, Row], tmp_path: Path) -> None:
    """It need not be as recorded any more."""
    for row in rows.values():
        assert _replayed(tmp_path, row).exit_code == 0
    edited = _condition(script=None, strategy="random", rate=1.0, step_limit=7)(rows["pots"])
    assert _replayed(tmp_path, edited).exit_code in (0, 1)


@pytest.mark.parametrize("name", config_names())
def test_rows_of_packaged_configurations_are_within_the_rules(name: str, tmp_path: Path) -> None:
    overrides = ["levels=[L1]"] if name == "levels" else []
    specs = plan_trials(load_config(name, ["limit=1", *overrides]))
    kinds = {repr((spec.scenario, spec.setting, spec.robot)): spec for spec in specs}
    for spec in kinds.values():
        with trial_of(tmp_path / "row.json", blank_record(spec), {}) as played:
            assert played.setting == spec.setting
