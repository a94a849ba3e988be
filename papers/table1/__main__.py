"""Print the page of published and measured, made from run folders."""

import argparse
import sys
from collections.abc import Sequence
from pathlib import Path

from papers.table1.document import Sources, document
from papers.table1.runs import Run, read_run
from testbed.config import ConfigError
from testbed.experiment import StoreError

BAD_INPUT = 2


def main(arguments: Sequence[str] | None = None) -> int:
    """The exit code: 0, or 2 with one line about what cannot be read."""
    parser = argparse.ArgumentParser("python -m papers.table1", description=__doc__)
    parser.add_argument("folder", type=Path, metavar="DIR", help="run folder of the protocol")
    parser.add_argument("--unaided", type=Path, help="one of a run without goal feedback")
    parser.add_argument("--later", type=Path, help="one of a run whose random events come later")
    parser.add_argument("--heeding", type=Path, help="one of a run with another `relevance`")
    parser.add_argument(
        "--variant", type=Path, nargs="*", default=(), help="of runs in a variant of the domain"
    )
    parser.add_argument("--told", type=Path, nargs="*", default=(), help="of benchmarks/told.py")
    given = parser.parse_args(arguments)
    try:
        variants, told = (tuple(map(read_run, own)) for own in (given.variant, given.told))
        runs = read_run(given.folder), _run(given.unaided), _run(given.later), _run(given.heeding)
        page = document(Sources(*runs, told, variants))
    except (StoreError, ConfigError, OSError) as error:
        print(error, file=sys.stderr)
        return BAD_INPUT
    print(page, end="")
    return 0


def _run(folder: Path | None) -> Run | None:
    return None if folder is None else read_run(folder)


if __name__ == "__main__":
    sys.exit(main())
