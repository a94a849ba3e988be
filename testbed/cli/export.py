"""Write a run's trials for other programs."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from testbed.cli.common import examples, input_errors, say

EPILOG = examples("testbed export runs/quickstart")


def command(
    folders: Annotated[list[Path], typer.Argument(metavar="DIR...", help="Run folders.")],
) -> None:
    """Write the stored trials of a run as trials.parquet and trials.csv into its folder."""
    from testbed.experiment.run_folder import read_config

    with input_errors():
        for folder in folders:
            read_config(folder)
        from testbed.analysis.table import export as write

        for folder in folders:
            for path in write(folder):
                say(str(path))
