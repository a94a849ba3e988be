"""Watch a run."""

import shlex
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from testbed.cli.common import DONE, examples, input_errors, say
from testbed.text import counted

if TYPE_CHECKING:
    from testbed.experiment.watching import View

EPILOG = examples(
    "testbed watch runs/table1",
    "testbed watch runs/table1 --robot intentional --failures",
    "testbed watch runs/table1 --once",
)


def command(
    folder: Annotated[
        Path, typer.Argument(metavar="DIR", help="Run folder; it need not be there yet.")
    ],
    robot: Annotated[
        str | None, typer.Option(metavar="NAME", help="Tell only stories of this robot.")
    ] = None,
    failures: Annotated[
        bool, typer.Option("--failures", help="Tell first what went wrong, then the newest.")
    ] = False,
    every: Annotated[
        float, typer.Option(metavar="SECONDS", min=0.01, help="Time between two looks.")
    ] = 1.0,
    once: Annotated[
        bool, typer.Option("--once", help="Look once, and do not wait for the run to end.")
    ] = False,
) -> None:
    """Show a run while another terminal plays it, and one robot's mind step by step.

    How many trials are on record, failed, how fast it goes, how the trials of each robot came out;
    then the newest trial: what is true, what the robot believes, intends, plans and explains. On a
    terminal with each look one step, elsewhere whole stories in plain lines. It ends with the run.
    """
    with input_errors(), _until_interrupted():
        from testbed.experiment.awaiting import wait_for_run
        from testbed.experiment.run_folder import CONFIG

        config = wait_for_run(folder, say, every, once)
        from testbed.cli.loading import search_beside
        from testbed.experiment.watching import Choice, Lines, watch

        search_beside(folder / CONFIG)
        view = Lines(say) if once else _view()
        status = watch(folder, config, Choice(robot, failures), view, every, once)
        missing = status.planned - status.done
        if missing > 0 and not once:
            go_on = shlex.join(["testbed", "run", str(folder / CONFIG), "--out", str(folder)])
            say(f"nobody plays the {counted(missing, 'trial')} left; to go on: {go_on} --resume")


@contextmanager
def _until_interrupted() -> Iterator[None]:
    try:
        yield
    except KeyboardInterrupt:  # the way to leave
        raise typer.Exit(DONE) from None


def _view() -> "View":
    from rich.console import Console

    from testbed.experiment.watching import Lines, Screen

    console = Console()
    draws = sys.stdout.isatty() and not console.is_dumb_terminal
    return Screen(console) if draws else Lines(say)
