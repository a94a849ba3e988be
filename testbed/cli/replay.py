"""Tell a stored trial step by step."""

from typing import Annotated

import typer

from testbed.cli.common import DONE, FAILED, Folder, examples, input_errors, say

EPILOG = examples(
    "testbed replay runs/quickstart", "testbed replay runs/quickstart --trial TRIAL_ID"
)


def command(
    folder: Folder,
    trial: Annotated[
        str | None,
        typer.Option(metavar="ID", help="Id of the trial, or its beginning; without it: a list."),
    ] = None,
) -> None:
    """Tell a trial step by step: world, belief, intention, explanation.

    Without --trial the trials of the run are listed. With it the trial is played again in this
    process; where that differs from the record it says so, and the exit code is 1.
    """
    from testbed.experiment.run_folder import read_config

    with input_errors():
        read_config(folder)
        from testbed.cli.loading import search_beside
        from testbed.experiment.replay import list_trials, replay

        if trial is None:
            list_trials(folder, say)
            return
        search_beside(folder / "config.yaml")
        as_recorded = replay(folder, trial, say)
    raise typer.Exit(DONE if as_recorded else FAILED)
