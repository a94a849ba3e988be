"""Print the page of the levels published and measured, made from a run folder."""

import argparse
import sys
from collections.abc import Sequence
from pathlib import Path

from papers.levels.document import document
from papers.levels.runs import read_run
from testbed.config import ConfigError
from testbed.experiment import StoreError

BAD_INPUT = 2


def main(arguments: Sequence[str] | None = None) -> int:
    """The exit code: 0, or 2 with one line about what cannot be read."""
    parser = argparse.ArgumentParser("python -m papers.levels", description=__doc__)
    parser.add_argument("folder", type=Path, metavar="DIR", help="run folder of the levels")
    given = parser.parse_args(arguments)
    try:
        page = document(read_run(given.folder))
    except (StoreError, ConfigError, OSError) as error:
        print(error, file=sys.stderr)
        return BAD_INPUT
    print(page, end="")
    return 0


if __name__ == "__main__":
    sys.exit(main())
