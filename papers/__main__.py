"""Draw the figures of a run of a published experiment into one SVG file."""

import argparse
import sys
from collections.abc import Sequence
from pathlib import Path

from papers.picture import picture
from testbed.config import ConfigError
from testbed.experiment import StoreError

BAD_INPUT = 2


def main(arguments: Sequence[str] | None = None) -> int:
    """The exit code: 0, or 2 with one line about what cannot be read."""
    parser = argparse.ArgumentParser("python -m papers", description=__doc__)
    parser.add_argument("folder", type=Path, metavar="DIR", help="run folder")
    parser.add_argument("file", type=Path, metavar="FILE.svg", help="what to write")
    given = parser.parse_args(arguments)
    try:
        given.file.write_text(picture(given.folder), encoding="utf-8")
    except (StoreError, ConfigError, OSError) as error:
        print(error, file=sys.stderr)
        return BAD_INPUT
    return 0


if __name__ == "__main__":
    sys.exit(main())
