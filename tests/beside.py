"""A command beside busy processes that are nicer: `python -m tests.beside N COMMAND...`."""

import subprocess
import sys
from contextlib import ExitStack

BUSY = (sys.executable, "-c", "import os; os.nice(19)\nwhile True: pass")


def main(number: int, command: list[str]) -> int:
    """Run the command while so many processes are busy; its exit code."""
    with ExitStack() as stack:
        for _ in range(number):
            busy = stack.enter_context(subprocess.Popen(BUSY))
            stack.callback(busy.kill)
        return subprocess.run(command, check=False).returncode


if __name__ == "__main__":
    raise SystemExit(main(int(sys.argv[1]), sys.argv[2:]))
