"""Print the page of the tournament, made from its run folder."""

import argparse
import sys
from collections.abc import Sequence
from pathlib import Path

from papers.sweeps import BAD_INPUT, study_of
from papers.text import render
from testbed.config import ConfigError
from testbed.experiment import StoreError
from testbed.studies import rows_of


def main(given: Sequence[str] | None = None) -> int:
    """The exit code: 0, or 2 with one line about what cannot be read."""
    parser = argparse.ArgumentParser("python -m papers.tournament", description=__doc__)
    parser.add_argument("folder", type=Path, metavar="DIR", help="run folder")
    try:
        study = study_of(parser.parse_args(given).folder)
    except (StoreError, ConfigError, OSError) as error:
        print(error, file=sys.stderr)
        return BAD_INPUT
    tables = [(view.title, view.columns, [*rows_of(view.lines)]) for view in study.section.views]
    print(render("tournament", study=study, tables=tables), end="")
    return 0


if __name__ == "__main__":
    sys.exit(main())
