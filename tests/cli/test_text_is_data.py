"""Names of users are shown as they are, wherever they are shown, and do nothing else there."""

import csv
import json
import os
import subprocess
import sys
import unicodedata
import xml.etree.ElementTree as ET
from pathlib import Path
from typing import Any

import pytest

from testbed.config import load_config

DOMAIN = """
sorts
  lamp  = {l1, l2}.
  clerk = {bob}.
fluents
  inertial lit(lamp).
actions
  agent     press(clerk, lamp).
  agent     unplug(clerk, lamp).
  exogenous exo_fuse(lamp).
laws
  press(C, L) causes lit(L).
  unplug(C, L) causes -lit(L).
  exo_fuse(L) causes -lit(L).
sees
  C sees lit(L) if clerk(C), lamp(L).
"""
CONFIG = """
name: lamps
domain: lamps.al
link: inprocess
goal: ["lit(l1)", "-lit(l2)"]
robots: [intentional, traditional]
script: []
"""
MARKUP = ("[/]", "lent [office1]", "[bold]x[/bold]", "<b>x</b>", "&amp;", "$\\frac$", "тень", "x\\")
STEERING = {
    "\x1b[31mred": "\\x1b[31mred",
    "two\nlines": "two\\nlines",
    "back\rward": "back\\rward",
    "\u202egnorw": "\\u202egnorw",
    "bell\x07\x9b1m": "bell\\x07\\x9b1m",
}
FORMULAS = ('=HYPERLINK("http://x")', "+1", "-lit(l1)", "@SUM(1)", "\tx")
NAMES = (*MARKUP, *STEERING, *FORMULAS)


def _run(*arguments: str, **environment: str) -> subprocess.CompletedProcess[bytes]:
    root = str(Path(__file__).parents[2])
    path = os.pathsep.join([root, os.environ.get("PYTHONPATH", "")])
    command = [sys.executable, "-m", "testbed", *arguments]
    variables = {**os.environ, "PYTHONPATH": path, "PYTHONIOENCODING": "utf-8", **environment}
    return subprocess.run(command, check=False, capture_output=True, env=variables)


@pytest.fixture(scope="module")
def run(tmp_path_factory: pytest.TempPathFactory) -> Any:
    """A run whose scenarios have such names, and what it printed."""
    folder = tmp_path_factory.mktemp("names")
    (folder / "lamps.al").write_text(DOMAIN, encoding="utf-8")
    config = f"{CONFIG}scenarios: {json.dumps(NAMES)}\n"
    (folder / "lamps.yaml").write_text(config, encoding="utf-8")
    done = _run("run", str(folder / "lamps.yaml"), "--out", str(folder / "run"))
    assert done.returncode == 0, done.stderr
    return folder / "run", done.stdout.decode()


def _steers(character: str) -> bool:
    return character != "\n" and unicodedata.category(character) in ("Cc", "Cf", "Zl", "Zp")


def test_the_terminal_shows_every_name_and_obeys_none(run: Any) -> None:
    _, shown = run
    assert not any(map(_steers, shown))
    for name in (*MARKUP, *STEERING.values(), *FORMULAS[:4]):
        lines = [line for line in shown.splitlines() if line.startswith(f"{name}  ")]
        assert len(lines) == 2, name


@pytest.mark.parametrize("command", ["report", "replay"])
def test_other_commands_show_them_too(run: Any, command: str) -> None:
    folder, _ = run
    done = _run(command, str(folder))
    assert done.returncode == 0, done.stderr
    shown = done.stdout.decode()
    assert not any(map(_steers, shown))
    assert all(name in shown for name in (*MARKUP, *STEERING.values()))


def test_what_an_encoding_lacks_is_replaced(run: Any) -> None:
    folder, _ = run
    done = _run("report", str(folder), PYTHONIOENCODING="ascii")
    assert (done.returncode, done.stderr) == (0, b"")
    assert any(line.startswith("????  ") for line in done.stdout.decode("ascii").splitlines())


def test_the_page_has_them_as_text(run: Any) -> None:
    folder, _ = run
    page = (folder / "report.html").read_text(encoding="utf-8")
    assert "<b>x</b>" not in page
    assert "&lt;b&gt;x&lt;/b&gt;" in page
    assert not any(_steers(character) for character in page if character not in "\r\t")
    figures = page.split("<svg ")[1:]
    assert figures
    for figure in figures:
        ET.fromstring("<svg " + figure.partition("</svg>")[0] + "</svg>")
    assert any("$\\frac$" in figure for figure in figures)


def test_no_cell_of_the_csv_is_a_formula(run: Any) -> None:
    folder, _ = run
    assert _run("export", str(folder)).returncode == 0
    with (folder / "trials.csv").open(encoding="utf-8", newline="") as file:
        rows = list(csv.DictReader(file))
    assert len(rows) == 2 * 4 * len(NAMES), "two robots, four initial states"
    assert not [c for row in rows for c in row.values() if c[:1] in tuple("=+-@\t\r\n")]
    assert {row["scenario"].removeprefix("'") for row in rows} == set(NAMES)
    # Literals are usable as they are: a negated one can begin with - inside of its list alone.
    assert all(json.loads(row["goal"]) == ["lit(l1)", "-lit(l2)"] for row in rows)


def test_the_configuration_comes_back_as_it_was(run: Any) -> None:
    folder, _ = run
    stored = (folder / "config.yaml").read_text(encoding="utf-8")
    assert not any(map(_steers, stored))
    assert load_config(folder / "config.yaml").scenarios == NAMES


def test_an_error_about_a_name_does_not_steer_the_terminal(tmp_path: Path) -> None:
    done = _run("run", "quickstart", 'robots=["\x1b[31mred\nx"]', "--out", str(tmp_path / "x"))
    assert done.returncode == 2
    told = done.stderr.decode()
    assert not any(map(_steers, told))
    assert len(told.splitlines()) == 1
