"""Each benchmark runs in its smallest size; its sides agree and nothing is left out."""

import json
import subprocess
import sys
from pathlib import Path

import pytest

from agents.shared import reasoning
from agents.shared.reasoning import MOST_DOMAINS
from asp.solving import Recent
from benchmarks import (
    decisions,
    driver,
    hostile,
    hostile_settings,
    large_runs,
    memory,
    mutation,
    peers,
    trials,
    worlds,
)
from benchmarks.__main__ import main
from benchmarks.growth import BOOKS, CARRIED, CORRIDORS, ROOMS, STEPS
from benchmarks.sheets import Row, Sheet
from benchmarks.trials import SCENARIOS, Played
from testbed.experiment.specs import TrialSpec

SETTLED_MB = 5.0


def rows_of(sheets: list[Sheet]) -> dict[str, list[Row]]:
    """The rows of each sheet, which all have the same columns."""
    for sheet in sheets:
        assert all(row.keys() == sheet.rows[0].keys() for row in sheet.rows)
    return {sheet.name: list(sheet.rows) for sheet in sheets}


def column(rows: list[Row], name: str) -> list[object]:
    return [row[name] for row in rows]


@pytest.mark.usefixtures("own_heap")
def test_decisions_of_all_scenarios_are_those_of_the_reference(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    played: dict[str, list[str]] = {}
    specs: dict[str, TrialSpec] = {}

    def play(spec: TrialSpec, side: str) -> Played:
        played.setdefault(spec.trial, []).append(side)
        specs[spec.trial] = spec
        return trials.play(spec, side)

    monkeypatch.setattr(decisions, "play", play)
    monkeypatch.setattr(reasoning, "_SESSIONS", Recent(MOST_DOMAINS))  # whose answers are forgotten
    sheets = rows_of(decisions.main("small"))
    for name in ("trials", "decisions"):
        assert column(sheets[name], "scenario") == list(SCENARIOS)
    assert column(sheets["fresh"], "scenario") == list(decisions.FRESH_SCENARIOS["small"])
    assert all(column(sheets["trials"], "agree"))
    assert all(column(sheets["decisions"], "decisions"))
    measured = {trial for trial, sides in played.items() if "reference" in sides}
    warm = played.keys() - measured
    assert {specs[trial].scenario for trial in warm} == set(SCENARIOS), "grounding is not measured"
    assert all(played[trial] == ["fast", "fast", "reference"] for trial in measured)
    assert {specs[t].initial for t in warm}.isdisjoint(specs[t].initial for t in measured)


def test_growth_has_every_point_and_the_sides_agree(tmp_path: Path) -> None:
    """In a process of its own: it looks through all objects of its process time and again."""
    command = [sys.executable, "-m", "benchmarks", "growth", "--size", "small"]
    subprocess.run([*command, "--out", str(tmp_path)], check=True, capture_output=True)
    told = json.loads((tmp_path / "growth.json").read_text(encoding="utf-8"))
    sheets = {sheet["name"]: sheet["rows"] for sheet in told["sheets"]}
    points = {"books": BOOKS, "rooms": ROOMS, "carrying": CARRIED, "corridor": CORRIDORS}
    for name, values in points.items():
        assert column(sheets[name], name) == list(values["small"])
        assert all(column(sheets[name], "agree"))
    history = sheets["history"]
    kinds = ("ordinary", "contradiction")
    asked = list(zip(column(history, "step"), column(history, "decision"), strict=True))
    assert asked == [(step, kind) for step in STEPS["small"] for kind in kinds]
    assert all(column(history, "agree"))


def test_peers_find_plans_of_the_same_length() -> None:
    sheets = rows_of(peers.main("small"))
    assert column(sheets["peers"], "problem") == ["P1", "P2"]
    assert column(sheets["peers"], "actions") == [6, 17]
    assert all(column(sheets["peers"], "agree"))


def test_trial_after_trial_takes_no_more_memory() -> None:
    rows = list(memory.soak(300, memory.alike(2), lambda spec: trials.play(spec, "fast")))
    assert [row["trials"] for row in rows] == [1, *range(30, 301, 30)]
    settled = [float(str(row["growth_mb"])) for row in rows[4:]]
    assert sum(settled) < SETTLED_MB


def test_memory_is_also_measured_over_more_goals_than_domains_are_kept() -> None:
    every = list(memory.varied(memory.GOALS["full"], memory.LEVELS["full"]))
    assert len({spec.setting.goal for spec in every}) > MOST_DOMAINS
    assert {spec.robot for spec in every} == {*memory.KINDS, *memory.FINE_KINDS}
    levels = {spec.level for spec in every if spec.setting.fine is not None}
    assert levels == set(memory.LEVELS["full"])


def test_goals_robots_and_levels_that_change_leave_no_more_controls_behind() -> None:
    few = list(memory.varied(memory.GOALS["small"], memory.LEVELS["small"]))
    _, *rows = memory.soak(3 * len(few), few, memory.play_any)
    first, *later = (row["controls"] for row in rows if int(str(row["trials"])) >= len(few))
    assert int(str(first)) > 0
    assert later == [first] * len(later)
    assert sum(float(str(row["growth_mb"])) for row in rows[-4:]) < SETTLED_MB


def test_the_driver_of_a_run_grows_by_what_it_knows_of_each_trial() -> None:
    sheets = rows_of(driver.main("small"))
    assert [row["trials"] for row in sheets["driver"]] == list(range(0, 121, 12))
    grown = [float(str(row["growth_mb"])) for row in sheets["driver"][1:]]
    assert sum(grown) < SETTLED_MB
    assert [(row["workers"], row["trials"]) for row in sheets["workers"]] == [(1, 24), (2, 24)]
    (rates,) = sheets["runners"]
    assert rates["round"] == 1
    assert float(str(rates["local_per_s"])) > 0
    assert float(str(rates["dask_per_s"])) > 0


def test_commands_about_a_made_run_end_well_and_are_measured() -> None:
    (rows,) = rows_of(large_runs.main("small")).values()
    commands = ["report", "report, the table stored", "export", "compare", "run --resume", "merge"]
    assert column(rows, "command") == commands
    assert len({*column(rows, "trials")}) == 1
    assert all(float(str(row["peak_mb"])) > 0 for row in rows)


def test_a_sample_of_mutants_is_killed_and_the_results_are_written_and_shown(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    main(["mutation", "--size", "small", "--out", str(tmp_path)])
    written = json.loads((tmp_path / "mutation.json").read_text(encoding="utf-8"))
    assert written["size"] == "small"
    sheets = {sheet["name"]: sheet["rows"] for sheet in written["sheets"]}
    assert list(sheets) == ["mutation", "redundant", "survivors", "killed"]
    assert len(sheets["mutation"]) == mutation.SAMPLE + len(mutation.QUICK)
    assert sheets["survivors"] == []
    assert "Each rule and each axiom left out" in capsys.readouterr().out


def test_there_are_mutants_of_every_paragraph_with_a_number_or_a_letter() -> None:
    left_out = {number for number, _ in mutation.all_mutants()}
    assert left_out >= set(range(1, 54))
    assert left_out >= {"defaults.a", "defaults.e", "diagnosis.b", "fine_planning.h"}


def test_an_unknown_benchmark_is_told_in_one_line(capsys: pytest.CaptureFixture[str]) -> None:
    with pytest.raises(SystemExit):
        main(["speed"])
    assert "unknown: speed; there are decisions" in capsys.readouterr().err


def test_worlds_have_a_row_a_level() -> None:
    (rows,) = rows_of(worlds.main("small")).values()
    assert column(rows, "level") == ["L1", "L3"]
    assert column(rows, "fluents") == [14, 188]
    assert column(rows, "events") == [1 * 4, 9 * 16]


@pytest.mark.usefixtures("own_heap")
def test_hostile_lives_are_explained_within_their_budgets_as_the_reference_does() -> None:
    sheets = rows_of(hostile.main("small"))
    rows = sheets["hostile"]
    columns = (column(rows, name) for name in ("setting", "relevance", "variant"))
    assert [hostile_settings.Kind(*map(str, kind)) for kind in zip(*columns, strict=True)] == [
        *hostile.KINDS
    ]
    assert {kind.setting for kind in hostile.KINDS} == hostile_settings.SETTINGS.keys()
    assert sum(int(str(cut)) for cut in column(rows, "cut")) == 0
    assert all(int(str(ended)) > 0 for ended in column(rows, "ended"))
    assert column(rows, "equal") == column(rows, "ended")
    sizes = [int(str(size)) for size in column(sheets["hidden"], "assumed_events")]
    assert sizes == sorted(sizes)
    assert sizes[-1] >= hostile.BIN
