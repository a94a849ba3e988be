"""Tell a stored trial step by step."""

from pathlib import Path
from typing import Annotated

import typer

from testbed.cli.common import DONE, FAILED, Folder, emit, examples, input_errors, refuse, say

EPILOG = examples(
    "testbed replay runs/quickstart",
    "testbed replay runs/quickstart --trial TRIAL_ID",
    "testbed replay runs/quickstart --trial TRIAL_ID --step 5 --program | python -m clingo",
)


def command(
    folder: Folder,
    trial: Annotated[
        str | None,
        typer.Option(metavar="ID", help="Id of the trial, or its beginning; without it: a list."),
    ] = None,
    step: Annotated[
        int | None, typer.Option(metavar="N", help="The step whose --program is asked for.")
    ] = None,
    program: Annotated[
        bool, typer.Option("--program", help="Write the program of a decision; see above.")
    ] = False,
    output: Annotated[
        Path | None, typer.Option("-o", "--output", metavar="FILE.lp", help="Instead of printing.")
    ] = None,
) -> None:
    """Tell a trial step by step: world, belief, intention, explanation.

    Without --trial the trials of the run are listed. With it the trial is played again in this
    process; where that differs from the record it says so, and the exit code is 1.

    With --step and --program it writes what an intentional robot reasoned with at this step, one
    text with the theory, the description, the history and the adopted explanation, of which clingo
    alone finds the intention.
    """
    from testbed.experiment.run_folder import naming, read_config

    if program and (trial is None or step is None):
        refuse(["--program: say of which decision, by --trial ID and --step N"])
    if not program and (step is not None or output is not None):
        option = "--output" if step is None else "--step"
        refuse([f"{option} is about the program of a decision; add --program"])
    with input_errors():
        read_config(folder)
        from testbed.cli.loading import search_beside
        from testbed.experiment.replay import list_trials, replay

        if trial is None:
            list_trials(folder, say)
            return
        search_beside(folder / "config.yaml")
        if program and step is not None:
            from testbed.cli.programs import replay_decisions

            text = replay_decisions(folder, trial).program(step)
            if output is None:
                emit(text)
                return
            with naming(output):
                output.write_text(text, encoding="utf-8")
            return
        as_recorded = replay(folder, trial, say)
    raise typer.Exit(DONE if as_recorded else FAILED)
