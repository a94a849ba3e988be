"""What goes wrong outside of a command is one line and an exit code, and costs no results."""

import resource
import shlex
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest
from typer.testing import CliRunner

from testbed.cli import app
from tests.cli.test_text_is_data import CONFIG, DOMAIN

ROOT = Path(__file__).parents[2]
PLAY = ["run", "lamps.yaml", "scenarios=[dusk]", "--out", "run"]


@pytest.fixture(autouse=True)
def _lamps(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """A domain and a configuration in the working folder."""
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("PYTHONPATH", str(ROOT))
    Path("lamps.al").write_text(DOMAIN, encoding="utf-8")
    Path("lamps.yaml").write_text(f"{CONFIG}scenarios: [dusk]\n", encoding="utf-8")


def _start(*arguments: str, **options: Any) -> subprocess.Popen[str]:
    command = [sys.executable, "-m", "testbed", *arguments]
    return subprocess.Popen(command, stderr=subprocess.PIPE, text=True, **options)


def _refused(*arguments: str) -> str:
    done = CliRunner().invoke(app, list(arguments))
    assert done.exit_code == 2, done.output
    (line,) = done.stderr.splitlines()
    return line


def test_a_reader_that_has_enough_is_no_error() -> None:
    process = _start(*PLAY, stdout=subprocess.PIPE)
    assert process.stdout is not None
    process.stdout.close()
    _, told = process.communicate()
    assert process.returncode == 0, told
    assert "Error" not in told
    assert {path.name for path in Path("run").iterdir()} >= {"report.html", "summary.json"}


@pytest.mark.skipif(not Path("/dev/full").exists(), reason="Linux has it")
@pytest.mark.parametrize(
    ("arguments", "code"), [(PLAY, 0), (["check", "lamps.yaml"], 2), (["--help"], 2)]
)
def test_output_that_cannot_be_written_is_told_in_a_line(arguments: list[str], code: int) -> None:
    """A run is not lost by it: all that it found is in its folder."""
    with Path("/dev/full").open("w") as full:
        process = _start(*arguments, stdout=full)
        _, told = process.communicate()
    assert process.returncode == code, told
    (line,) = (line for line in told.splitlines() if "preparing" not in line)
    assert line.startswith("standard output: ")
    assert code or Path("run/report.html").exists()


@pytest.mark.parametrize("closed", ["<&- >&-", "<&- >&- 2>&-"])
@pytest.mark.parametrize("arguments", ["check lamps.yaml", "translate lamps.al"])
def test_output_that_was_closed_before_is_no_error(arguments: str, closed: str) -> None:
    command = f"exec {shlex.quote(sys.executable)} -m testbed {arguments} {closed}"
    done = subprocess.run(["/bin/sh", "-c", command], check=False, capture_output=True)
    assert (done.returncode, done.stderr) == (0, b"")


def _limited(most: int) -> Callable[[], None]:
    """No file may become larger, as on a full disk."""
    return lambda: resource.setrlimit(resource.RLIMIT_FSIZE, (most, most))


@pytest.mark.parametrize(
    ("arguments", "most", "file"),
    [
        (["report", "run"], 8_000, "run/report.html"),
        (["translate", "lamps.al", "-o", "lamps.lp"], 100, "lamps.lp"),
        (["export", "run"], 100, "run/trials.csv"),
    ],
)
def test_a_full_disk_is_told_with_the_file(arguments: list[str], most: int, file: str) -> None:
    assert CliRunner().invoke(app, [*PLAY, "limit=1", "--quiet"]).exit_code == 0
    process = _start(*arguments, stdout=subprocess.DEVNULL, preexec_fn=_limited(most))
    _, told = process.communicate()
    assert process.returncode == 2, told
    (line,) = told.splitlines()
    assert line.startswith(f"{file}: ")


def test_a_disk_without_room_for_the_table_is_told() -> None:
    assert CliRunner().invoke(app, [*PLAY, "limit=1", "--quiet"]).exit_code == 0
    Path("run/table.json").unlink()
    process = _start("export", "run", stdout=subprocess.DEVNULL, preexec_fn=_limited(100))
    _, told = process.communicate()
    assert process.returncode == 2, told
    (line,) = told.splitlines()
    assert line.startswith("run/trials.parquet: ")


def test_records_that_cannot_be_written_are_told_with_their_file() -> None:
    program = """
import resource, sys
from pathlib import Path
from testbed.cli.common import input_errors
from testbed.experiment.store import TrialWriter
from tests.experiment.samples import a_record
resource.setrlimit(resource.RLIMIT_FSIZE, (3000, 3000))
with input_errors(), TrialWriter(Path("run")) as writer:
    for number in range(100):
        writer.append(a_record(f"t{number}"))
"""
    command = [sys.executable, "-c", program]
    done = subprocess.run(command, check=False, capture_output=True, text=True)
    assert "run/trials.jsonl: " in done.stderr.splitlines()[0]


@pytest.mark.parametrize("line", [b'{"trial": "\xff\xfe"}', b"[" * 10**5 + b"]" * 10**5, b"\x00"])
def test_bad_bytes_in_the_records_are_told_with_file_and_line(line: bytes) -> None:
    assert CliRunner().invoke(app, [*PLAY, "limit=1", "--quiet"]).exit_code == 0
    with Path("run/trials.jsonl").open("ab") as file:
        file.write(line + b"\n")
    for command in ("report", "export"):
        assert _refused(command, "run").startswith("run/trials.jsonl:3: ")


def test_a_domain_that_is_no_text_is_told_with_its_place() -> None:
    Path("bad.al").write_bytes(b"sorts\n  lamp = {\xff}.\n")
    assert _refused("translate", "bad.al").startswith("bad.al:2:11: ")
    assert "bad.al:2:11: " in _refused("check", "lamps.yaml", "domain=bad.al")


@pytest.mark.parametrize(
    ("change", "place"),
    [
        (("fluents\n", "fluents\n  inertial near(lamp, lamp).\n"), "large.al:6"),
        (("laws\n", "laws\n  -lit(X) if lit(Y), lit(Z), X != Y, Y != Z.\n"), "large.al:12"),
    ],
)
def test_a_description_with_too_many_instances_is_refused(
    change: tuple[str, str], place: str
) -> None:
    text = DOMAIN.replace("{l1, l2}", "{1..2000}").replace(*change)
    Path("large.al").write_text(text, encoding="utf-8")
    for command in (["translate", "large.al"], ["check", "lamps.yaml", "domain=large.al"]):
        line = _refused(*command)
        assert place in line
        assert "instances" in line


@pytest.mark.parametrize("last", ["99999999", "9" * 5000])
def test_a_sort_with_too_many_members_is_refused(last: str) -> None:
    Path("range.al").write_text(DOMAIN.replace("{l1, l2}", f"{{1..{last}}}"), encoding="utf-8")
    line = _refused("translate", "range.al")
    assert line.startswith("range.al:3:")


@pytest.mark.parametrize(
    ("size", "place"),
    [
        ("{rooms: 2000, rows: 100, columns: 100, objects: [[1, 1]]}", "level_sizes.w"),
        ("{rooms: 2, rows: 1, columns: 2, objects: [[1000, 1000]]}", "level_sizes.w"),
        ("{rooms: 1000, rows: 1, columns: 1, objects: [[50, 1]]}", "instances"),
    ],
)
def test_a_level_that_is_too_large_is_refused(size: str, place: str) -> None:
    line = _refused("check", "levels", "levels=[w]", f"level_sizes.w={size}")
    assert place in line


@pytest.mark.parametrize("depth", [100, 100_000])
def test_a_goal_that_is_nested_is_refused(depth: int) -> None:
    nested = "[" * depth + "]" * depth
    text = CONFIG.replace('["lit(l1)", "-lit(l2)"]', nested)
    Path("nested.yaml").write_text(text, encoding="utf-8")
    assert _refused("check", "nested.yaml").startswith("nested.yaml:")
    assert "goal" in _refused("check", "lamps.yaml", f"goal={nested}")
