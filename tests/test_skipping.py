"""In CI a test that is skipped for want of a package, or of a program, fails."""

import os
import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[1]
TEST = """
import pytest

def test_needs_it():
    pytest.importorskip("no_such_package")
"""
FILE = """
import pytest

pytest.importorskip("no_such_package")
"""
PROGRAM = """
import shutil
import pytest

@pytest.mark.skipif(not shutil.which("no_such_package"), reason="there is no no_such_package here")
def test_needs_it():
    pass
"""


@pytest.mark.parametrize("text", [TEST, FILE, PROGRAM], ids=["test", "file", "program"])
def test_what_is_skipped_for_want_of_something_fails_in_ci(tmp_path: Path, text: str) -> None:
    (tmp_path / "test_wanting.py").write_text(text)
    command = ["-m", "pytest", "-q", "-p", "tests.conftest", "test_wanting.py"]
    environment = {**os.environ, "CI": "true", "PYTHONPATH": str(ROOT)}
    done = subprocess.run(
        [sys.executable, *command], cwd=tmp_path, env=environment, check=False, capture_output=True
    )
    assert done.returncode in (1, 2), done.stdout
    assert b"no_such_package" in done.stdout
