"""Where a run came from: the revision of a checkout, and what differs from it."""

import subprocess
from pathlib import Path

import pytest

from testbed.experiment.provenance import revision


@pytest.fixture
def checkout(tmp_path: Path) -> Path:
    """A repository with one file in its only revision."""
    root = tmp_path / "checkout"
    root.mkdir()
    (root / "code.py").write_text("one\n")
    for command in (
        ["init", "--quiet"],
        ["add", "code.py"],
        ["-c", "user.name=a", "-c", "user.email=a@b", "commit", "--quiet", "-m", "first"],
    ):
        subprocess.run(["git", "-C", str(root), *command], check=True)
    return root


def _kept(tmp_path: Path, checkout: Path) -> tuple[object, bool]:
    """What is said to have changed, and whether a patch was written."""
    found = revision(tmp_path, checkout)
    assert found is not None
    return found["changed"], (tmp_path / "difference.patch").exists()


def test_an_unchanged_checkout_leaves_no_patch(tmp_path: Path, checkout: Path) -> None:
    assert _kept(tmp_path, checkout) == ([], False)


def test_files_that_git_does_not_know_leave_no_patch(tmp_path: Path, checkout: Path) -> None:
    (checkout / "notes.txt").write_text("mine\n")
    assert _kept(tmp_path, checkout) == (["?? notes.txt"], False)


def test_what_differs_can_be_applied_again(tmp_path: Path, checkout: Path) -> None:
    (checkout / "code.py").write_text("one\ntwo \n\n")
    assert _kept(tmp_path, checkout) == ([" M code.py"], True)
    for command in (["checkout", "--quiet", "code.py"], ["apply", "../difference.patch"]):
        subprocess.run(["git", "-C", str(checkout), *command], check=True)
    assert (checkout / "code.py").read_text() == "one\ntwo \n\n"


def test_outside_a_checkout_there_is_no_revision(tmp_path: Path) -> None:
    assert revision(tmp_path, tmp_path) is None
