"""Small experiments for the tests of this folder."""

from pathlib import Path

import pytest

from testbed.config import ExperimentConfig, load_config
from tests.experiment.samples import Configure


@pytest.fixture
def configure() -> Configure:
    """The quickstart in process, with overrides."""

    def make(*overrides: str) -> ExperimentConfig:
        return load_config("quickstart", ["link=inprocess", *overrides])

    return make


@pytest.fixture
def at_home(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A working folder of the test's own."""
    monkeypatch.chdir(tmp_path)
    return tmp_path
