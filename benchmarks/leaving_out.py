"""A pytest plugin: the tests run without one statement of a theory, named by a variable.

`LEFT_OUT=incremental_planning:16 pytest -p benchmarks.leaving_out` leaves out what begins in line
16. In processes that a test starts nothing is left out.
"""

import os
import resource
import sys
import time

from hypothesis import Phase, settings

from asp.solving import solver as solving
from benchmarks.statements import without

VARIABLE = "LEFT_OUT"

TEST_S = 60
"""Seconds of processor time for one test: what takes more is ended by the system."""

_complete = solving.theory


def pytest_sessionstart() -> None:
    """The first example that fails is enough, and each time the same ones are drawn."""
    if VARIABLE in os.environ:  # after tests/conftest.py, of whose settings the others stay
        phases = (Phase.explicit, Phase.generate)
        settings.register_profile("leaving_out", phases=phases, derandomize=True, database=None)
        settings.load_profile("leaving_out")


def pytest_runtest_setup() -> None:
    """Gives the next test its time."""
    _, most = resource.getrlimit(resource.RLIMIT_CPU)
    resource.setrlimit(resource.RLIMIT_CPU, (int(time.process_time()) + TEST_S, most))


def leave_out(key: str) -> None:
    """From now on `asp.solving.solver.theory` gives the theory of `THEORY:LINE` without that
    statement.

    Raises ValueError where no statement begins there.
    """
    name, line = key.split(":")
    shortened = without(name, int(line))

    def theory(asked: str) -> str:
        return shortened if asked == name else _complete(asked)

    for module in list(sys.modules.values()):
        if vars(module).get("theory") is _complete:
            vars(module)["theory"] = theory


if VARIABLE in os.environ:
    leave_out(os.environ[VARIABLE])
