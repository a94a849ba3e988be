"""A run whose driver is killed in the middle, and which then goes on.

`python -m benchmarks.killing RECORDS run CONFIG ...` is `testbed run CONFIG ...`, whose driver says
that it is held, and stands still, as soon as so many records are written. Of several numbers
(`8,16`) it is held at each, until it gets a line.
"""

import subprocess
import sys
from collections.abc import Collection, Sequence
from pathlib import Path

from testbed import cli
from testbed.experiment import runner
from testbed.experiment.record import TrialRecord
from testbed.experiment.run_folder import TRIALS
from testbed.experiment.store import TrialWriter

HELD = "held"
COMMAND = (sys.executable, "-m", "benchmarks.killing")


class NotKilledError(RuntimeError):
    """The run ended by itself before it was killed."""


def killed_at(records: int, arguments: Sequence[str], folder: Path) -> bytes:
    """Kill (SIGKILL) the driver of `testbed ARGUMENTS` when its run has so many records.

    `folder` is that of the run. The whole lines of `trials.jsonl` that the driver leaves.

    Raises:
        NotKilledError: where the driver ends before that.
    """
    command = [*COMMAND, str(records), *arguments]
    with subprocess.Popen(command, stdin=subprocess.PIPE, stdout=subprocess.PIPE) as driver:
        assert driver.stdout is not None
        held = any(line.strip() == HELD.encode() for line in driver.stdout)
        driver.kill()
    if not held:
        raise NotKilledError(f"{folder}: its driver ended before it was killed")
    return whole_lines(folder / TRIALS)


def whole_lines(path: Path) -> bytes:
    """What a file of lines holds without a torn last one."""
    kept = path.read_bytes()
    return kept[: kept.rfind(b"\n") + 1]


def _held_at(records: Collection[int]) -> type[TrialWriter]:
    """A writer that stands still at each of these numbers, until it gets a line or is killed."""

    class Held(TrialWriter):
        def append(self, record: TrialRecord) -> None:
            super().append(record)
            if len(self.done) in records:
                print(HELD, flush=True)
                if not sys.stdin.readline():
                    raise SystemExit("its parent has ended")

    return Held


def numbers(records: str) -> set[int]:
    """The numbers of records that stand in an argument."""
    return {int(number) for number in records.split(",") if number}


def main() -> None:
    """The command line with a writer that stands still."""
    _, records, *arguments = sys.argv
    sys.argv = ["testbed", *arguments]
    runner.TrialWriter = _held_at(numbers(records))  # type: ignore[attr-defined]
    cli.main()


if __name__ == "__main__":
    main()
