"""The table of a run beside its records: when it stands for them, and when it does not."""

import hashlib
import os
import shutil
from collections.abc import Callable
from concurrent.futures import ProcessPoolExecutor
from multiprocessing import get_context
from pathlib import Path

import msgspec
import polars as pl
import pytest
from polars.testing import assert_frame_equal
from typer.testing import CliRunner

from testbed.analysis import load_run
from testbed.analysis.stored_table import MADE_OF, PARQUET
from testbed.analysis.table import table_of
from testbed.cli import app
from testbed.experiment import StoreError
from testbed.experiment.digest import digest
from testbed.experiment.run_folder import PROVENANCE, REPORT, TRIALS
from testbed.experiment.store import encode, read_records
from tests.pots import write_pots

OFFICE = ["office", "link=inprocess", "limit=1", "scenarios=[1,4]"]
LEVELS = ["levels", "link=inprocess", "limit=1", "levels=[L1]"]


def _testbed(*arguments: str | Path) -> int:
    return CliRunner().invoke(app, list(map(str, arguments))).exit_code


def _played(where: Path, *given: str | Path) -> Path:
    """The folder of a run that was played and reported."""
    assert _testbed("run", *given, "--out", where, "--workers", "1", "--quiet") == 0
    return where


@pytest.fixture(scope="module")
def played(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return _played(tmp_path_factory.mktemp("played") / "run", *OFFICE)


@pytest.fixture
def folder(played: Path, tmp_path: Path) -> Path:
    return Path(shutil.copytree(played, tmp_path / "run"))


def _shorten(folder: Path, **told: str) -> None:
    """Leave one row in the stored table, so that it shows where it is used, and tell this of it."""
    pl.read_parquet(folder / PARQUET).head(1).write_parquet(folder / PARQUET)
    known = msgspec.json.decode((folder / MADE_OF).read_bytes())
    known |= {"table": hashlib.sha256((folder / PARQUET).read_bytes()).hexdigest()} | told
    (folder / MADE_OF).write_bytes(msgspec.json.encode(known))


def _rows(folder: Path) -> int:
    return len(load_run(folder).trials)


@pytest.mark.parametrize("given", [OFFICE, LEVELS, ["pots"]])
def test_it_is_the_table_of_the_records_with_their_digest(given: list[str], tmp_path: Path) -> None:
    if given == ["pots"]:
        given = [str(write_pots(tmp_path)), "repeats=1"]
    where = _played(tmp_path / "run", *given)
    assert (where / PARQUET).is_file()
    found, records = load_run(where), list(read_records(where))
    assert_frame_equal(found.trials, table_of(records))
    assert found.digest == digest(records)
    assert list(found.records()) == records


@pytest.mark.parametrize("given", [OFFICE, LEVELS, ["pots"]])
def test_a_report_does_not_make_it_again(given: list[str], tmp_path: Path) -> None:
    if given == ["pots"]:
        given = [str(write_pots(tmp_path)), "repeats=1"]
    where = _played(tmp_path / "run", *given)
    before = os.stat(where / PARQUET).st_ino
    assert _testbed("report", where) == 0
    assert _testbed("export", where) == 0
    assert os.stat(where / PARQUET).st_ino == before


def test_it_stands_for_the_records(folder: Path) -> None:
    _shorten(folder)
    assert _rows(folder) == 1


def _with_another(folder: Path) -> None:
    """One more record, of the first trial under another id."""
    first = next(read_records(folder))
    first.trial = "another"
    with (folder / TRIALS).open("ab") as file:
        file.write(encode(first))


def _with_one_less(folder: Path) -> None:
    lines = (folder / TRIALS).read_bytes().splitlines(keepends=True)
    (folder / TRIALS).write_bytes(b"".join(lines[:-1]))


def _in_other_order(folder: Path) -> None:
    lines = (folder / TRIALS).read_bytes().splitlines(keepends=True)
    (folder / TRIALS).write_bytes(b"".join(reversed(lines)))


@pytest.mark.parametrize("change", [_with_another, _with_one_less, _in_other_order])
def test_it_does_not_stand_for_other_records(folder: Path, change: Callable[[Path], None]) -> None:
    change(folder)
    _shorten(folder)
    assert_frame_equal(load_run(folder).trials, table_of(read_records(folder)))


@pytest.mark.parametrize("key", ["code", "records", "table"])
def test_one_that_other_code_made_of_other_records_is_made_again(folder: Path, key: str) -> None:
    _shorten(folder, **{key: "another"})
    assert _rows(folder) == 4
    assert _testbed("export", folder) == 0
    assert len(pl.read_parquet(folder / PARQUET)) == 4


@pytest.mark.parametrize("content", [b"", b"{}", b"\xff", b"[" * 9999, b'{"table": 7}'])
@pytest.mark.parametrize("file", [PARQUET, MADE_OF])
def test_what_is_no_table_is_replaced(folder: Path, file: str, content: bytes) -> None:
    _shorten(folder)
    (folder / file).write_bytes(content)
    assert _rows(folder) == 4
    assert _testbed("report", folder) == 0
    assert len(pl.read_parquet(folder / PARQUET)) == 4


@pytest.mark.parametrize("at", [0.05, 0.3, 0.6, 0.9])
def test_a_damaged_one_is_never_taken_for_the_records(folder: Path, at: float) -> None:
    content = bytearray((folder / PARQUET).read_bytes())
    place = int(at * len(content))
    content[place : place + 8] = bytes(255 - byte for byte in content[place : place + 8])
    (folder / PARQUET).write_bytes(content)
    assert_frame_equal(load_run(folder).trials, table_of(read_records(folder)))


@pytest.mark.parametrize("file", [PARQUET, MADE_OF])
@pytest.mark.parametrize("kind", ["folder", "loop", "nowhere", "pipe", "forbidden"])
def test_what_is_no_file_is_no_table(folder: Path, file: str, kind: str) -> None:
    where = folder / file
    content = where.read_bytes()
    where.unlink()
    if kind == "folder":
        where.mkdir()
    elif kind == "pipe":
        os.mkfifo(where)
    elif kind == "forbidden":
        where.write_bytes(content)
        where.chmod(0)
    else:
        where.symlink_to(where if kind == "loop" else "nowhere")
    assert _rows(folder) == 4


def test_a_report_is_made_where_the_table_cannot_be_stored(folder: Path) -> None:
    """As on a disk without room for it: there is a folder in its place."""
    for file in (PARQUET, REPORT):
        (folder / file).unlink()
    (folder / PARQUET).mkdir()
    done = CliRunner().invoke(app, ["report", str(folder)])
    assert done.exit_code == 0
    assert PARQUET in done.stderr
    assert (folder / REPORT).is_file()


def test_an_export_without_trials_leaves_nothing(folder: Path) -> None:
    for file in (PARQUET, MADE_OF, TRIALS):
        (folder / file).unlink()
    before = sorted(folder.iterdir())
    assert _testbed("export", folder) == 2
    assert sorted(folder.iterdir()) == before


def test_reports_of_one_run_may_be_made_at_once(folder: Path) -> None:
    for _ in range(3):
        (folder / MADE_OF).unlink()
        with ProcessPoolExecutor(2, get_context("spawn")) as pool:
            assert list(pool.map(_testbed_again, [folder] * 4)) == [0] * 4
        assert not list(folder.glob("*.part"))
        assert _rows(folder) == 4


def _testbed_again(folder: Path) -> int:
    return _testbed("report", folder)


@pytest.mark.parametrize("content", [b"", b"[", b"[]", b"\xff"])
def test_a_run_is_read_though_its_provenance_is_not_known(folder: Path, content: bytes) -> None:
    (folder / PROVENANCE).write_bytes(content)
    assert load_run(folder).provenance == {}
    for command in ("report", "compare"):
        assert _testbed(command, folder) == 0


def test_records_of_other_trials_are_refused_though_an_export_has_them(folder: Path) -> None:
    _with_another(folder)
    assert _testbed("export", folder) == 0
    assert len(pl.read_parquet(folder / PARQUET)) == 5
    assert _testbed("report", folder) == 2
    (folder / REPORT).unlink()


def test_a_damaged_record_is_refused_though_there_is_a_table(folder: Path) -> None:
    text = (folder / TRIALS).read_bytes()
    (folder / TRIALS).write_bytes(text.replace(b'"achieved":true', b'"achieved":null', 1))
    with pytest.raises(StoreError):
        load_run(folder)


def test_a_run_that_goes_on_has_all_of_its_trials_in_it(tmp_path: Path) -> None:
    where = tmp_path / "run"
    assert _testbed("run", *OFFICE, "--out", where, "--workers", "1", "--shard", "1/2") == 0
    assert len(pl.read_parquet(where / PARQUET)) == 2
    assert _testbed("run", *OFFICE, "--out", where, "--workers", "1", "--resume") == 0
    assert len(pl.read_parquet(where / PARQUET)) == 4


def test_a_folder_that_may_not_be_written_is_read(folder: Path) -> None:
    """As by `compare`, of runs of somebody else: nothing is stored."""
    (folder / PARQUET).unlink()
    before = sorted(folder.iterdir())
    assert _rows(folder) == 4
    assert sorted(folder.iterdir()) == before
