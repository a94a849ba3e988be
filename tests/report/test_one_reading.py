"""Everything that a report says is made of one table: the records of a run are read once."""

import sys
from collections.abc import Callable
from pathlib import Path

import pytest
from typer.testing import CliRunner

from testbed.cli import app

OPENED: list[str] = []
"""Files that were opened for reading; a hook of the interpreter cannot be taken away again."""


@pytest.fixture(scope="module")
def opened() -> Callable[[Path], int]:
    """How often a file was opened for reading since the beginning of these tests."""

    def hook(event: str, arguments: tuple[object, ...]) -> None:
        if event == "open" and arguments[1] in ("r", "rb"):
            OPENED.append(str(arguments[0]))

    sys.addaudithook(hook)
    return lambda path: OPENED.count(str(path))


def _do(*arguments: object) -> None:
    done = CliRunner().invoke(app, [str(argument) for argument in arguments])
    assert done.exit_code == 0, done.output


@pytest.mark.parametrize(
    "arguments",
    [
        ("quickstart", "scenarios=[1,4]"),
        ("table1", "scenarios=[2]", "limit=1"),
        ("levels", "levels=[L1]", "limit=1"),
    ],
    ids=lambda arguments: arguments[0],
)
def test_a_report_and_an_export_read_each_record_once(
    tmp_path: Path, arguments: tuple[str, ...], opened: Callable[[Path], int]
) -> None:
    folder = tmp_path / "run"
    _do("run", *arguments, "link=inprocess", "--out", folder, "--quiet")
    for command in ("report", "export"):
        for stored in (False, True):
            if not stored:
                (folder / "table.json").unlink()
            before = opened(folder / "trials.jsonl")
            _do(command, folder)
            hashed, read = 1, 0 if stored else 1
            assert opened(folder / "trials.jsonl") - before == hashed + read
