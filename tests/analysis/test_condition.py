"""The condition of a run: where published figures stand beside it, and what is said of it."""

import json
from pathlib import Path

import pytest

from testbed.analysis.condition import condition, deviations
from testbed.cli import app
from testbed.config import load_config
from testbed.studies import left_out
from tests.greenhouse import WINDY

SAME = ("seed=7", "limit=2", "scenarios=[1]", "repeats=2", "limits.answer_s=5", "link=zenoh")


@pytest.mark.parametrize(
    ("study", "overrides", "named"),
    [
        ("table1", SAME, ()),
        ("table1", ["robots=[traditional, intentional-checking, intentional]"], ()),
        ("table1", ["observability={exo_move: {mode: never}}"], ()),
        ("table1", ["goal=[loc(book1,library)]"], ("goal",)),
        ("table1", ["observability={exo_lock: {mode: always}}"], ("observability",)),
        ("table1", ["goal_feedback=false"], ("goal feedback",)),
        ("table1", ["scenario_settings.2.goal_feedback=false"], ("goal feedback",)),
        ("table1", ["knowledge=seen"], ("knowledge",)),
        ("table1", ["relevance=definition"], ("relevance",)),
        ("table1", ["plans=conformant"], ("plans",)),
        ("table1", ["adversary.rate=0.5"], ("adversary",)),
        ("table1", ["adversary.strategy=random"], ("adversary",)),
        ("table1", ["script=[]"], ("adversary",)),
        ("table1", ["limits.steps=9"], ("limits",)),
        ("table1", ["robots=[intentional]"], ("robots",)),
        ("table1", ["initial=[loc(rob1,kitchen),loc(book1,kitchen),loc(book2,kitchen)]"],
         ("initial state",)),
        ("levels", ["limit=3", "levels=[L2]", "robots=[intentional, intentional-nozoom]"], ()),
        ("levels", ["statistics={}"], ("statistics",)),
        ("levels", ["adversary.pace=abstract"], ("adversary",)),
        ("levels", ["draw.holding=0.5"], ("draw",)),
    ],
)  # fmt: skip
def test_a_run_is_as_published_unless_its_rules_are_others(
    study: str, overrides: list[str], named: tuple[str, ...]
) -> None:
    config = load_config(study, overrides)
    assert deviations(config, load_config(study)) == named
    assert (left_out(config) is None) == (not named)


TEXT = """\
name: pots
protocol: table1
domain: pots.al
goal: ["stands(fern,sill)"]
scenarios: [calm]
limit: 1
link: inprocess
"""


def _run(folder: Path, *arguments: str) -> tuple[dict[str, object], str]:
    with pytest.raises(SystemExit) as ended:
        app(["run", *arguments, "--out", str(folder / "run"), "--workers", "1"])
    assert ended.value.code == 0
    summary = json.loads((folder / "run" / "summary.json").read_text(encoding="utf-8"))
    page = (folder / "run" / "report.html").read_text(encoding="utf-8")
    return summary["table1"]["intentional"]["triggered"]["rows"], page


def test_another_domain_has_no_published_figures_beside_it(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    (tmp_path / "pots.al").write_text(WINDY.replace("calm:", "1:"), encoding="utf-8")
    (tmp_path / "pots.yaml").write_text(TEXT.replace("calm", "1"), encoding="utf-8")
    rows, page = _run(tmp_path, str(tmp_path / "pots.yaml"))
    printed = capsys.readouterr().out
    assert _values(rows, "published") == {None}
    assert "domain" in next(line for line in printed.splitlines() if "left out" in line)
    assert "  published" not in printed
    assert 'class="published' not in page
    said = next(line for line in printed.splitlines() if line.startswith("condition: "))
    assert said.removeprefix("condition: ") in page.replace("&#39;", "'")


def test_one_pair_stands_beside_the_published_figures_without_an_interval(tmp_path: Path) -> None:
    rows, _ = _run(tmp_path, "table1", "limit=1", "scenarios=[1]", "link=inprocess")
    assert _values({"1": rows["1"]}, "published") - {None}
    assert _values(rows, "low") == _values(rows, "high") == _values(rows, "inside") == {None}
    assert _values({"all": rows["all"]}, "published") == {None}  # that is of five scenarios


def _values(part: object, key: str) -> set[object]:
    """The values of a key at any depth."""
    if not isinstance(part, dict):
        return set()
    found = {part[key]} if key in part else set()
    return found.union(*(_values(inner, key) for inner in part.values()))


def test_the_condition_names_what_the_robot_is_told_of_and_what_others_do() -> None:
    told = "observability={exo_lock: {mode: always, delay: 2}}"
    rules = [told, "knowledge=seen", "adversary.rate=0.25", "limits.decision_s=7"]
    rules += ["relevance=plan", "plans=conformant"]
    said = condition(load_config("table1", rules))
    words = (
        "exo_lock (always, delay 2)",
        "seen",
        "0.25",
        "steps 100",
        "decision 7.0 s",
        ": plan",
        "conformant",
    )
    assert all(word in said for word in words)
    script = "scenario_settings.1.script=[]"
    assert "in 1" in condition(load_config("table1", ["scenarios=[1, 2]", script]))
    assert "fine_move" in condition(load_config("levels"))
    random = condition(load_config("table1", ["adversary={strategy: random}"]))
    assert "0.1" in random


def test_of_a_sweep_it_is_what_all_conditions_have_in_common() -> None:
    said = condition(load_config("rate"))
    assert "adversary.rate" in said
    assert "at rate" not in said
    assert "relevance" in said
    assert "relevance: " not in condition(load_config("attention"))
