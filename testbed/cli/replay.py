"""Tell a stored trial step by step."""

from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from testbed.cli.common import DONE, FAILED, emit, examples, input_errors, refuse, say
from testbed.text import warn

if TYPE_CHECKING:
    from testbed.experiment.record import TrialRecord
    from testbed.experiment.specs import TrialSpec

EPILOG = examples(
    "testbed replay runs/quickstart",
    "testbed replay runs/quickstart --trial TRIAL_ID",
    "testbed replay runs/quickstart --trial TRIAL_ID --step 5 --program | python -m clingo",
    "testbed replay runs/quickstart --trial TRIAL_ID --row -o row.json",
    "testbed replay row.json",
)


def command(
    source: Annotated[
        Path, typer.Argument(metavar="DIR|ROW.json", help="Run folder, or one trial of one.")
    ],
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
    row: Annotated[
        bool, typer.Option("--row", help="Write the trial as one file; see above.")
    ] = False,
    output: Annotated[
        Path | None, typer.Option("-o", "--output", metavar="FILE", help="Instead of printing.")
    ] = None,
) -> None:
    """Tell a trial step by step: world, belief, intention, explanation.

    Without --trial the trials of the run are listed. With it the trial is played again in this
    process; where that differs from the record it says so, and the exit code is 1.

    With --row it writes the record with the texts of its domain instead, one file that replays by
    itself on any machine; a line of trials.jsonl does, too, where its domain is packaged or lies
    beside it.

    With --step and --program it writes what an intentional robot reasoned with at this step, one
    text with the theory, the description, the history and the adopted explanation, of which clingo
    alone finds the intention.
    """
    from testbed.experiment.run_folder import read_config

    alone = source.is_file()
    _refuse_options(alone, trial, step, program, row, output)
    with input_errors():
        if not alone:
            read_config(source)
        from testbed.experiment.replay import list_trials, replay_trial

        if not alone and trial is None:
            list_trials(source, say)
            return
        with _trial(source, trial) as (spec, recorded):
            if row:
                _write(output, _row(source, spec, recorded))
            elif program and step is not None:
                from testbed.cli.programs import decisions_of

                _write(output, decisions_of(spec, recorded).program(step))
            else:
                raise typer.Exit(DONE if replay_trial(spec, recorded, say) else FAILED)


def _refuse_options(
    alone: bool, trial: str | None, step: int | None, program: bool, row: bool, output: Path | None
) -> None:
    """Refuse options that do not go together."""
    if alone and (trial is not None or row):
        option = "--row" if row else "--trial"
        refuse([f"{option}: is about a run folder, and this file is one trial; leave it out"])
    if row and (trial is None or program):
        refuse(["--row: say of which trial, by --trial ID, and without --program"])
    if program and (step is None or not (alone or trial)):
        refuse(["--program: say of which decision, by --trial ID and --step N"])
    if step is not None and not program:
        refuse(["--step is about the program of a decision; add --program"])
    if output is not None and not (program or row):
        refuse(["--output is about what is written; add --program or --row"])


@contextmanager
def _trial(source: Path, trial: str | None) -> Iterator[tuple["TrialSpec", "TrialRecord | None"]]:
    """The trial of a run folder, or of a file, to be played within this block, and its record."""
    from testbed.analysis.rows import read_row
    from testbed.cli.loading import search_beside
    from testbed.experiment.replay import stored_trial
    from testbed.experiment.rows import other_versions, trial_of
    from testbed.registry import search_last

    if not source.is_file():
        search_beside(source / "config.yaml")
        yield stored_trial(source, trial or "")
        return
    record, texts = read_row(source)
    search_last(source.resolve().parent)
    with trial_of(source, record, texts) as spec:
        if (told := other_versions(record.origin)) is not None:
            warn(told)
        yield spec, record


def _row(source: Path, spec: "TrialSpec", recorded: "TrialRecord | None") -> str:
    from testbed.experiment.errors import StoreError
    from testbed.experiment.rows import row_of

    if recorded is None:
        raise StoreError(f"{source}: has no record of trial {spec.trial} yet")
    return row_of(spec, recorded).decode()


def _write(output: Path | None, text: str) -> None:
    from testbed.experiment.run_folder import naming

    if output is None:
        emit(text)
        return
    with naming(output):
        output.write_text(text, encoding="utf-8")
