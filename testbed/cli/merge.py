"""Merge the parts of a run."""

import sys
from pathlib import Path
from typing import Annotated

import typer

from testbed.cli.common import Folders, examples, input_errors

EPILOG = examples("testbed merge parts/1 parts/2 -o runs/table1", "testbed merge parts/* -o run")


def command(
    folders: Folders,
    out: Annotated[Path, typer.Option("-o", "--out", metavar="DIR", help="Run folder to make.")],
) -> None:
    """Make one run of the parts that `testbed run --shard I/N` played, and its report.

    The parts have to be of one configuration, played with the same versions; each trial of the
    run has to be in exactly one of them.
    """
    with input_errors():
        from testbed.experiment.merge import merge

        config = merge(folders, out, ["testbed", *sys.argv[1:]])
        from testbed.cli.loading import search_beside
        from testbed.cli.session import report_again

        search_beside(folders[0] / "config.yaml")  # where a study of one's own lies
        report_again(out, config)
