"""A study of one's own, by its place and by an entry point: in report, summary and terminal."""

import json
import re
import subprocess
import sys
from pathlib import Path

import pytest

from tests.greenhouse import GREENHOUSE

ROOT = Path(__file__).parents[2]
CONFIG = """\
name: pots
protocol: "{protocol}"
domain: pots.al
goal: ["stands(fern,sill)"]
initial: ["stands(fern,bench)", "stands(rose,floor)"]
scenarios: none
link: inprocess
"""
PYTHON = re.compile(r"```python\n(.*?)```", re.DOTALL)
LINE = re.compile(r"^pots\.yaml:2: protocol: .+$")


@pytest.fixture
def here(tmp_path: Path) -> Path:
    """A folder with a domain, and the study that the documents show."""
    (tmp_path / "pots.al").write_text(GREENHOUSE, encoding="utf-8")
    (shown,) = PYTHON.findall((ROOT / "docs" / "studies.md").read_text(encoding="utf-8"))
    (tmp_path / "counting.py").write_text(shown, encoding="utf-8")
    return tmp_path


def _testbed(folder: Path, protocol: str, *arguments: str) -> subprocess.CompletedProcess[str]:
    (folder / "pots.yaml").write_text(CONFIG.format(protocol=protocol), encoding="utf-8")
    command = [sys.executable, "-m", "testbed", *arguments]
    return subprocess.run(command, cwd=folder, capture_output=True, text=True, check=False)


def _registered(folder: Path) -> None:
    """The study as that of an installed distribution; what lies beside a configuration is found."""
    metadata = folder / "counting-1.dist-info"
    metadata.mkdir()
    (metadata / "METADATA").write_text("Name: counting\nVersion: 1\n", encoding="utf-8")
    group = "[intention_testbed.studies]\ncounting = counting:STUDY\n"
    (metadata / "entry_points.txt").write_text(group, encoding="utf-8")


@pytest.mark.parametrize("protocol", ["counting:STUDY", "counting"])
def test_it_has_its_part_of_the_report_the_summary_and_the_terminal(
    here: Path, protocol: str
) -> None:
    _registered(here)
    ran = _testbed(here, protocol, "run", "pots.yaml", "--out", "run", "--workers", "1")
    assert ran.returncode == 0, ran.stderr
    records = [
        json.loads(line) for line in (here / "run" / "trials.jsonl").read_text().splitlines()
    ]
    steps = {record["robot"]: record["steps"] for record in records}
    summary = json.loads((here / "run" / "summary.json").read_text(encoding="utf-8"))
    assert summary["steps"] == steps
    page = (here / "run" / "report.html").read_text(encoding="utf-8")
    section = page.partition('<h2 id="steps">')[2].partition("<h2")[0]
    for robot, number in steps.items():
        assert f"<div>{robot}</div>" in section
        assert f"<div>{number}.0</div>" in section.replace("\n", "")
        assert re.search(rf"{robot} +{number}\.0", ran.stdout)
    assert "<svg" in section
    assert "published" not in section
    again = _testbed(here, protocol, "report", "run")
    assert again.returncode == 0, again.stderr
    assert (here / "run" / "report.html").read_text(encoding="utf-8") == page


@pytest.mark.parametrize("protocol", ["count", "counting:NONE", "counting:numbers", "levels"])
def test_what_is_no_study_for_the_trials_is_refused_in_a_line(here: Path, protocol: str) -> None:
    checked = _testbed(here, protocol, "check", "pots.yaml")
    assert checked.returncode == 2
    (line,) = checked.stderr.splitlines()
    assert LINE.match(line)
    assert protocol.partition(":")[0] in line


def test_scenarios_are_not_for_a_study_of_the_levels(here: Path) -> None:
    checked = _testbed(here, "x", "check", "levels", "protocol=table1")
    assert checked.returncode == 2
    (line,) = checked.stderr.splitlines()
    assert "protocol" in line
    assert "levels" in line
