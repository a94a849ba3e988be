"""What the tests of the report in a browser share."""

from collections.abc import Iterator

import pytest

from testbed.config import load_config
from tests.report.browser import CHROMIUM, Browser
from tests.report.explorer import Played

SWEPT = ["link=inprocess", "sweep.grid={goal_feedback: [true, false]}"]
"""Trials of two conditions."""


@pytest.fixture(scope="module")
def browser(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Browser]:
    """A browser with a profile of its own."""
    assert CHROMIUM is not None
    opened = Browser(CHROMIUM, tmp_path_factory.mktemp("profile"))
    yield opened
    opened.close()


@pytest.fixture(scope="module")
def run(tmp_path_factory: pytest.TempPathFactory) -> Played:
    """A run with several scenarios, both robots, and trials that failed."""
    return Played(tmp_path_factory.mktemp("quickstart"), load_config("quickstart", SWEPT))
