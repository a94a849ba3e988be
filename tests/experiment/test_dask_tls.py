"""A scheduler at tls:// is spoken to with the files that are given; those of no use are named."""

import subprocess
import sys
from pathlib import Path

import pytest
from typer.testing import CliRunner

from benchmarks.clusters import scheduler, worker
from testbed.cli import app
from testbed.experiment.record import TrialRecord
from testbed.experiment.store import read_records
from testbed.registry import PATH_VARIABLE
from tests.pots import write_pots

CURVE = ("-newkey", "ec", "-pkeyopt", "ec_paramgen_curve:prime256v1")


@pytest.fixture(autouse=True)
def pots(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A configuration, and two certificates beside it, each its own authority, with their keys."""
    monkeypatch.setenv(PATH_VARIABLE, "")
    monkeypatch.setattr(sys, "path", list(sys.path))
    monkeypatch.chdir(tmp_path)
    file = write_pots(tmp_path / "beside")
    for name in ("own", "other"):
        files = ("-keyout", f"{name}.key", "-out", f"{name}.pem")
        command = ("openssl", "req", "-x509", *CURVE, "-nodes", "-days", "2", "-subj", "/CN=pots")
        subprocess.run([*command, *files], cwd=file.parent, check=True, capture_output=True)
    return file


def _run(pots: Path, scheduler: str, ca: str, cert: str, key: str) -> tuple[int, str]:
    """Exit code and errors of two trials."""
    files = [f"tls.ca={ca}", f"tls.cert={cert}", f"tls.key={key}"]
    given = [str(pots), "limit=1", "runner=dask", f"scheduler={scheduler}", *files]
    done = CliRunner().invoke(app, ["run", *given, "--out", "run", "--resume", "--quiet"])
    return done.exit_code, done.stderr


def _played() -> list[TrialRecord]:
    return list(read_records(Path("run")))


@pytest.mark.load
def test_trials_are_played_over_tls(pots: Path, tmp_path: Path) -> None:
    files = {"--tls-ca-file": "own.pem", "--tls-cert": "own.pem", "--tls-key": "own.key"}
    given = [text for key, file in files.items() for text in (key, str(pots.parent / file))]
    with scheduler(tmp_path / "scheduler", *given, host="tls://127.0.0.1") as own:
        assert own.address.startswith("tls://")
        code, errors = _run(pots, own.address, "other.pem", "own.pem", "own.key")
        assert (code, len(errors.splitlines()), _played()) == (2, 1, [])
        assert own.address in errors
        with worker(own.address, tmp_path / "worker", *given):
            assert _run(pots, own.address, "own.pem", "own.pem", "own.key") == (0, "")
    assert len(_played()) == 2


@pytest.mark.parametrize(
    ("files", "named"),
    [
        (("no.pem", "own.pem", "own.key"), ["tls.ca", "no.pem"]),
        (("own.pem", "no.pem", "own.key"), ["tls.cert", "no.pem"]),
        (("own.pem", "own.pem", "no.key"), ["tls.key", "no.key"]),
        (("own.key", "own.pem", "own.key"), ["tls.ca", "own.key"]),
        (("own.pem", "own.pem", "other.key"), ["tls.cert", "tls.key", "other.key"]),
        (("own.pem", "pots.al", "own.key"), ["tls.cert", "pots.al"]),
    ],
)
def test_a_file_of_no_use_is_named(
    pots: Path, files: tuple[str, str, str], named: list[str]
) -> None:
    code, errors = _run(pots, "tls://127.0.0.1:1", *files)
    (line,) = errors.splitlines()
    assert (code, _played()) == (2, [])
    assert [name for name in named if name not in line] == []


def test_workers_of_a_scheduler_are_not_given_a_number(pots: Path) -> None:
    given = [str(pots), "runner=dask", "scheduler=tcp://127.0.0.1:1", "--out", "run", "--quiet"]
    done = CliRunner().invoke(app, ["run", *given, "--workers", "2"])
    (line,) = done.stderr.splitlines()
    assert done.exit_code == 2
    assert "--workers" in line
    assert "scheduler" in line
    assert not Path("run/config.yaml").exists()
