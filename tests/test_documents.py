"""What the documents show works: code blocks run, commands exist, links lead somewhere."""

import re
import runpy
import shlex
import subprocess
import sys
from pathlib import Path

import pytest
import typer
from typer.testing import CliRunner

from testbed.cli import app
from testbed.config import load_config
from testbed.experiment.plan import plan_trials
from testbed.experiment.robots import make_robot
from testbed.experiment.trial import play_trial
from testbed.link import InProcessRobot

ROOT = Path(__file__).parent.parent
DOCUMENTS = [ROOT / "README.md", ROOT / "CONTRIBUTING.md", *sorted((ROOT / "docs").glob("*.md"))]
BLOCK = re.compile(r"^```(\w+)\n(.*?)^```", re.MULTILINE | re.DOTALL)
README = (ROOT / "README.md").read_text(encoding="utf-8")
LEVEL_ROBOTS = ("zoom", "no zoom")
LINK = re.compile(r"\]\(([^)#:]+)\)")


def _blocks(language: str) -> list[str]:
    return [
        text
        for document in DOCUMENTS
        for found, text in BLOCK.findall(document.read_text(encoding="utf-8"))
        if found == language
    ]


@pytest.fixture(scope="module")
def home(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A folder with the configurations of the project and a run."""
    folder = tmp_path_factory.mktemp("home")
    (folder / "configs").symlink_to(ROOT / "configs")
    run = ["run", "quickstart", "scenarios=[1]", "link=inprocess", "limits.decision_s=null"]
    arguments = [*run, "--out", str(folder / "runs" / "quickstart")]
    done = CliRunner().invoke(app, arguments, catch_exceptions=False)
    assert done.exit_code == 0, done.output
    return folder


@pytest.mark.parametrize("code", _blocks("python"))
def test_python_blocks_run(code: str, home: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(home)
    exec(compile(code, "<document>", "exec"), {})


@pytest.mark.parametrize("document", DOCUMENTS, ids=lambda path: path.name)
def test_links_lead_somewhere(document: Path) -> None:
    for target in LINK.findall(document.read_text(encoding="utf-8")):
        assert (document.parent / target).exists(), f"{document.name}: {target}"


def _page(name: str) -> str:
    return (ROOT / "docs" / name).read_text(encoding="utf-8")


def _cells(page: str, row: str) -> list[list[str]]:
    """The rows of the page's tables that begin so."""
    found = (line.strip("| ").split(" | ") for line in page.splitlines() if line.startswith("| "))
    return [[cell.strip() for cell in cells] for cells in found if cells[0].strip() == row]


def test_the_figures_of_the_published_comparison_are_those_of_its_page() -> None:
    page, told = _page("published-and-measured.md"), " ".join(README.split())
    failed = re.search(r"ATI was not correct in 0 of (\d+) trials", page)
    assert failed
    pairs = int(failed[1])
    undone = page.partition("## When TP fails")[2].partition("## ")[0]
    rows = [line.split(" | ") for line in undone.splitlines() if re.match(r"\| \w+, \d", line)]
    counts = [[int(n) for cell in row[2::2] for n in re.findall(r"\d+", cell)] for row in rows]
    wrong = sum(of - right + others - also for right, of, also, others in counts)
    assert len(rows) > 5
    assert f"right in all of {pairs} pairs of trials and TP in {1 - wrong / pairs:.0%}" in told
    triggered, random = (float(row[7].split("%")[0]) for row in _cells(page, "all")[:2])
    assert f"TP is right in {triggered:.0f}% where it was triggered" in told
    assert f"and in {random:.0f}% where events were drawn at random" in told
    ways = (_cells(page, way) for way in ("random", "triggered"))
    inside = (next(cell for row in rows for cell in row if " of 20" in cell) for rows in ways)
    random_ones, triggered_ones = inside
    assert f"{random_ones} lie in our intervals where events were drawn" in told
    assert f"where scenarios were triggered, {triggered_ones} do" in told


def test_the_figures_of_the_levels_are_those_of_their_page() -> None:
    page = _page("levels-published-and-measured.md")
    shares = page.partition("**Trials that achieved")[2].partition("**No zoom")[0]
    rows = [line.split(" | ") for line in shares.splitlines() if re.match(r"\| L\d", line)]
    assert {row[3].split("%")[0] for row in rows} == {"100.0"}
    trials = {kind: sum(int(row[2]) for row in rows if row[1] == kind) for kind in LEVEL_ROBOTS}
    assert f"of {sum(trials.values())} trials at [the levels]" in " ".join(README.split())
    assert trials["zoom"] == trials["no zoom"]


def _commands() -> set[str]:
    lines = [line for block in _blocks("console") for line in block.splitlines()]
    return {match.group(1) for line in lines if (match := re.match(r"\$ testbed (\w+)", line))}


def test_every_command_shown_exists() -> None:
    shown = _commands()
    assert {"run", "check", "replay", "report", "translate"} <= shown
    for command in shown:
        arguments = [sys.executable, "-m", "testbed", command, "--help"]
        assert subprocess.run(arguments, cwd=ROOT, capture_output=True, check=False).returncode == 0


def _shown() -> list[tuple[str, ...]]:
    """The arguments of every `testbed` shown, in documents and in comments of configurations."""
    lines = [line.removeprefix("$ ") for block in _blocks("console") for line in block.splitlines()]
    for config in sorted((ROOT / "configs").glob("*.yaml")):
        comments = re.findall(r"^#(.*)", config.read_text(encoding="utf-8"), re.MULTILINE)
        lines += [re.sub(r"^.*?(?=testbed )", "", comment) for comment in comments]
    split = (shlex.split(line, comments=True) for line in lines if line.startswith("testbed "))
    return sorted({tuple(words[1:]) for words in split})


def _checkable(arguments: tuple[str, ...]) -> list[str]:
    """What checks the command: itself, or for a run its configuration and overrides."""
    command, *others = arguments
    if command != "run":
        return list(arguments)
    parsed = typer.main.get_command(app).commands["run"].make_context("run", others)
    return ["check", parsed.params["config"], *(parsed.params["overrides"] or ())]


@pytest.mark.parametrize(
    "arguments",
    [shown for shown in _shown() if shown[0] in ("check", "run", "translate")],
    ids=" ".join,
)
def test_the_configurations_shown_are_valid(
    arguments: tuple[str, ...], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(ROOT)
    done = CliRunner().invoke(app, _checkable(arguments))
    assert done.exit_code == 0, done.output
    assert done.stdout


SCRIPT = re.compile(r"\[\{step: .*?\}\]")


@pytest.mark.parametrize("file", ["docs/configuration.md", "configs/office.yaml"])
def test_every_script_shown_can_be_played(file: str) -> None:
    shown = SCRIPT.findall((ROOT / file).read_text(encoding="utf-8"))
    assert shown
    for script in shown:
        config = load_config("quickstart", ["scenarios=[1]", f"script={script}"])
        for spec in plan_trials(config):
            record = play_trial(spec, InProcessRobot(make_robot)).record
            assert (record.outcome, len(record.exogenous)) == ("achieved", 1), record.reason


def test_the_filmstrip_is_drawn(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    target = tmp_path / "strip.png"
    monkeypatch.setattr(sys, "argv", ["filmstrip.py", str(target)])
    runpy.run_path(str(ROOT / "examples" / "filmstrip.py"), run_name="__main__")
    assert target.read_bytes().startswith(b"\x89PNG")
