"""Theories without one of their statements, each in a process that runs the tests they are for."""

import os
import re
import subprocess
import sys
from collections.abc import Iterable, Iterator, Sequence
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from signal import SIGXCPU

from benchmarks.exercised import EXERCISED
from benchmarks.leaving_out import TEST_S, VARIABLE
from benchmarks.sheets import DisagreementError
from benchmarks.statements import Statement

ROOT = Path(__file__).parent.parent
TIME = f"time: a test took more than {TEST_S} s"

_PYTEST = (sys.executable, "-m", "pytest", "-x", "-q", "-p", "no:cacheprovider")
_PASSED, _FAILED, _INTERRUPTED = 0, 1, 2
_FAILURE = re.compile(r"^(?:FAILED|ERROR) (?P<test>.+?)(?: - .*)?$", re.MULTILINE)


def killers(mutants: Iterable[Statement]) -> Iterator[tuple[Statement, str]]:
    """What is left out, and the first test that fails then; "": none, TIME: one does not end.

    Raises RuntimeError where pytest could not run the tests.
    """
    with ThreadPoolExecutor(os.cpu_count()) as pool:
        yield from pool.map(lambda mutant: (mutant, _killer(mutant)), mutants)


def check_killers(tests: Iterable[str]) -> None:
    """Raises DisagreementError where one of the tests fails with nothing left out."""
    given = sorted(set(tests) - {"", TIME})
    if given and (failing := _first_failure(given, {})):
        raise DisagreementError(f"{failing} fails with nothing left out")


def _killer(mutant: Statement) -> str:
    return _first_failure(EXERCISED[mutant.theory], {VARIABLE: mutant.key})


def _first_failure(tests: Sequence[str], variables: dict[str, str]) -> str:
    command = [*_PYTEST, "-p", "benchmarks.leaving_out", *tests]
    ran = subprocess.run(
        command, cwd=ROOT, env={**os.environ, **variables}, capture_output=True, text=True
    )
    if ran.returncode == _PASSED:
        return ""
    if ran.returncode == -SIGXCPU:
        return TIME
    found = _FAILURE.search(ran.stdout)
    if found is None or ran.returncode not in (_FAILED, _INTERRUPTED):
        raise RuntimeError(f"{' '.join(command)}: {ran.stdout[-2000:]}{ran.stderr[-2000:]}")
    return found["test"]
