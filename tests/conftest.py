"""What all tests share: small experiments, and settings for a machine that is busy."""

import signal
from pathlib import Path

import pytest
from hypothesis import HealthCheck, settings

from testbed.config import ExperimentConfig, load_config
from tests.experiment.samples import Configure

settings.register_profile(
    "busy machine", deadline=None, suppress_health_check=[HealthCheck.too_slow]
)
settings.load_profile("busy machine")

# A suite in the background, or one of `nohup`, ignores these, and so would every process that tests
# interrupt.
if signal.getsignal(signal.SIGINT) is signal.SIG_IGN:
    signal.signal(signal.SIGINT, signal.default_int_handler)
if signal.getsignal(signal.SIGHUP) is signal.SIG_IGN:
    signal.signal(signal.SIGHUP, signal.SIG_DFL)


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
