"""Memory of a process that plays trial after trial."""

from __future__ import annotations

import os
import resource
from collections.abc import Iterator
from itertools import cycle, islice
from pathlib import Path

from benchmarks.sheets import Row, Sheet, gathered
from benchmarks.trials import SCENARIOS, play, specs

_STATUS = Path("/proc/self/statm")

TRIALS = {"small": 300, "full": 10_000}
SAMPLES = 10
STATES = {"small": 2, "full": 192}


def main(size: str) -> list[Sheet]:
    """Sheet `memory`: resident memory after so many trials."""
    notes = (
        "scenarios 1 to 6 in turn, from different initial states, nothing forgotten in between;",
        "the first row is after the first trial",
    )
    title = "Resident memory of one process, link included"
    return [Sheet("memory", title, gathered(soak(TRIALS[size], STATES[size])), notes)]


def soak(trials: int, states: int) -> Iterator[Row]:
    """Plays so many trials; a row after the first one and after each tenth of them."""
    pool = [spec for scenario in SCENARIOS for spec in specs(scenario, states)]
    before: float | None = None
    for number, spec in enumerate(islice(cycle(pool), trials), start=1):
        play(spec, "fast")
        if number == 1 or number % (trials // SAMPLES) == 0:
            now = resident_mb()
            yield {
                "trials": number,
                "resident_mb": now,
                "growth_mb": None if before is None else now - before,
            }
            before = now


def resident_mb() -> float:
    """Resident memory of this process in MB; the most it ever had where there is no /proc."""
    if _STATUS.exists():
        pages = int(_STATUS.read_text(encoding="ascii").split()[1])
        return pages * os.sysconf("SC_PAGE_SIZE") / 1e6
    return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1e3
