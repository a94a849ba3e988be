"""Search for episodes in which a robot fails."""

from pathlib import Path
from typing import Annotated

import typer

from testbed.cli.common import Config, Overrides, Swept, examples, input_errors
from testbed.text import warn

EPILOG = examples(
    "testbed stress stress --minutes 1",
    "testbed stress office robots=[traditional] limit=10 --events 1",
    "testbed stress stress stress.objectives=[fail,waste] stress.waste=100 --workers 2",
    "testbed stress stress --out runs/stress --resume",
)


def command(
    config: Config,
    overrides: Overrides = None,
    sweep: Swept = False,
    minutes: Annotated[
        float | None, typer.Option(help="How long to search; without it stress.minutes.")
    ] = None,
    events: Annotated[
        int | None,
        typer.Option(help="The most exogenous actions per episode; without it stress.events."),
    ] = None,
    out: Annotated[
        Path | None, typer.Option(help="Folder; without it runs/NAME-stress, numbered if taken.")
    ] = None,
    workers: Annotated[int, typer.Option(min=1, help="Processes that play episodes.")] = 1,
    resume: Annotated[
        bool, typer.Option("--resume", help="Go on with what the folder has.")
    ] = False,
    quiet: Annotated[bool, typer.Option("--quiet", help="Say nothing but errors.")] = False,
) -> None:
    """Search for fair episodes in which a robot fails, and write the simplest of each kind.

    The trials of the configuration are played with every single exogenous action that is legal,
    then with more of them. What is found is shrunk to the simplest story, told, and written as a
    configuration that replays it, with tests for pytest.

    Exit code 0: nothing was found; 1: something was.
    """
    from testbed.cli.loading import load

    given = [*(overrides or [])]
    given += [] if minutes is None else [f"stress.minutes={minutes}"]
    given += [] if events is None else [f"stress.events={events}"]
    with input_errors():
        loaded = load(config, given, sweep)
        if not quiet:
            warn(f"preparing {loaded.name}: the cases of its plan")
        from testbed.cli.stress_session import stress_session

        code = stress_session(loaded, out, workers, resume, quiet)
    raise typer.Exit(code)
