"""The command line where a machine grants little, and where paths are as people name them."""

import json
import os
import subprocess
import sys
from collections.abc import Iterator, Sequence
from pathlib import Path
from shutil import which

import pytest

ROOT = Path(__file__).parents[1]
LIMITED = """
import os, resource, sys
{limit}
os.execv(sys.executable, [sys.executable, "-m", "testbed", *sys.argv[1:]])
"""
"""The command line, limited before it begins."""
NOBODY = "65534"
READS = "dac_read_search"
SOMEBODY = (
    f"setpriv --reuid {NOBODY} --regid {NOBODY} --clear-groups"
    f" --inh-caps +{READS} --ambient-caps +{READS}",
    "setpriv --bounding-set -dac_override,-dac_read_search",
)
"""What takes rights away from root: all but reading, or that to pass over the modes of files."""
TRIAL = ("scenarios=[2]", "robots=[intentional]", "--quiet")
GARDEN = """
sorts
  bed   = {north, south}.
  robot = {ida}.
fluents
  inertial watered(bed).
actions
  agent     water(robot, bed).
  exogenous dry_out(bed).
laws
  water(R, B) causes watered(B).
  dry_out(B) causes -watered(B).
sees
  R sees watered(B) if robot(R).
scenarios
  quiet: nothing.
"""


def _done(command: Sequence[str | Path], folder: Path, **variables: str) -> str:
    """What a command prints that succeeds and has nothing to complain of."""
    environment = {**os.environ, "PYTHONPATH": str(ROOT), **variables}
    done = subprocess.run(
        command, cwd=folder, env=environment, capture_output=True, text=True, check=False
    )
    assert (done.returncode, done.stderr) == (0, "")
    return done.stdout


def _limited(limit: str) -> list[str]:
    return [sys.executable, "-c", LIMITED.format(limit=limit)]


def _outcomes(folder: Path) -> list[str]:
    lines = (folder / "trials.jsonl").read_text(encoding="utf-8").splitlines()
    return [json.loads(line)["outcome"] for line in lines]


@pytest.fixture
def elsewhere(tmp_path: Path) -> Path:
    """A folder whose name needs quotes in a shell and more than ASCII."""
    folder = tmp_path / "Grüße & Söhne" / "meine Läufe"
    folder.mkdir(parents=True)
    return folder


@pytest.fixture
def sealed(tmp_path: Path) -> Iterator[Path]:
    """A folder that may be read, and not written to."""
    folder = tmp_path / "sealed"
    folder.mkdir()
    folder.chmod(0o555)
    yield folder
    folder.chmod(0o755)


def _somebody(sealed: Path) -> list[str]:
    """What to begin a command with so that it cannot write into the folder."""
    if os.geteuid() != 0:
        return []
    program = f"import testbed; open({str(sealed / 'probe')!r}, 'w')"
    for prefix in SOMEBODY if which("setpriv") else ():
        command = [*prefix.split(), sys.executable, "-c", program]
        done = subprocess.run(command, cwd=ROOT, capture_output=True, text=True, check=False)
        if "PermissionError" in done.stderr:
            return prefix.split()
    raise AssertionError("root can write everywhere, and nothing here takes that right away")


def test_a_user_without_rights_whose_home_is_read_only(elsewhere: Path, sealed: Path) -> None:
    elsewhere.chmod(0o777)
    command = [*_somebody(sealed), sys.executable, "-m", "testbed", "run", "quickstart", *TRIAL]
    places = dict.fromkeys(("HOME", "XDG_CONFIG_HOME", "XDG_CACHE_HOME"), str(sealed))
    assert _done([*command, "--out", "run"], elsewhere, **places) == ""
    assert _outcomes(elsewhere / "run") == ["achieved"]
    assert list(sealed.iterdir()) == []


@pytest.mark.versions
def test_paths_have_blanks_and_umlauts(elsewhere: Path) -> None:
    (elsewhere / "mein Gärtchen.al").write_text(GARDEN, encoding="utf-8")
    (elsewhere / "erster Versuch.yaml").write_text(
        json.dumps({"name": "garden", "domain": "mein Gärtchen.al", "goal": ["watered(north)"]}),
        encoding="utf-8",
    )
    testbed = [sys.executable, "-m", "testbed"]
    given = ["scenarios=[quiet]", "initial=[-watered(north)]", "robots=[intentional]", "--quiet"]
    out = "ä ö/ü"
    _done([*testbed, "run", "erster Versuch.yaml", *given, "--out", out], elsewhere)
    assert _outcomes(elsewhere / out) == ["achieved"]
    again = [*testbed, "run", f"{out}/config.yaml", "--quiet", "--out", "noch einmal"]
    _done(again, elsewhere)
    assert _outcomes(elsewhere / "noch einmal") == ["achieved"]
    assert out in _done([*testbed, "report", out], elsewhere)


def test_one_processor_is_used_by_one_worker(elsewhere: Path) -> None:
    limit = "os.sched_setaffinity(0, sorted(os.sched_getaffinity(0))[:1])"
    _done([*_limited(limit), "run", "quickstart", *TRIAL, "--out", "run"], elsewhere)
    assert _outcomes(elsewhere / "run") == ["achieved"]
    provenance = json.loads((elsewhere / "run/provenance.json").read_text(encoding="utf-8"))
    assert provenance["workers"] == 1


def test_few_files_are_open_at_once(elsewhere: Path) -> None:
    """Two workers, a process of a robot for each, and no more files after more trials."""
    limit = "resource.setrlimit(resource.RLIMIT_NOFILE, (48, 48))"
    command = [*_limited(limit), "run", "quickstart", "robots=[traditional]", "--quiet"]
    _done([*command, "--workers", "2", "--out", "run"], elsewhere)
    assert len(_outcomes(elsewhere / "run")) == 6
    assert not {"error", "robot_lost"} & set(_outcomes(elsewhere / "run"))
