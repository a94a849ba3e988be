"""The command line, one module per command.

Exit codes: 0 done; 1 trials ended in error; 2 bad input; 130 interrupted or terminated.

A command imports what only it needs when it is called: a robot's process is to be there quickly, a
mistyped command is to be refused quickly, and statistics alone take longer to import than either.
"""

import importlib.metadata
import sys
from typing import Annotated

import typer

from testbed.cli import (
    check,
    compare,
    diagram,
    explain,
    export,
    merge,
    plan,
    play,
    repair,
    replay,
    report,
    robot,
    run,
    stress,
    translate,
    watch,
)
from testbed.cli.common import BAD_INPUT, DONE, refuse
from testbed.cli.importing import displaced
from testbed.text import mute, tolerant, warn

COMMANDS = (
    run,
    stress,
    check,
    robot,
    report,
    compare,
    export,
    replay,
    watch,
    play,
    merge,
    repair,
    translate,
    plan,
    explain,
    diagram,
)
"""In the order of the help. Each has a function of its own name, and the end of its help."""

app = typer.Typer(
    name="testbed",
    no_args_is_help=True,
    add_completion=False,
    pretty_exceptions_enable=False,
    rich_markup_mode=None,
)


def _version(wanted: bool) -> None:
    if wanted:
        typer.echo(f"testbed {importlib.metadata.version('intention-testbed')}")
        raise typer.Exit(DONE)


@app.callback()
def common(
    version: Annotated[  # noqa: ARG001  # its callback says it
        bool,
        typer.Option(
            "--version", callback=_version, is_eager=True, help="Print the version and exit."
        ),
    ] = False,
) -> None:
    """Reasoning robots in a world that others change: run experiments, look into them."""
    problem = displaced()
    if problem is not None:
        refuse([problem])


def main() -> None:
    """Entry point of the distribution."""
    tolerant()
    try:
        app(prog_name="testbed")
    except OSError as error:  # of the help, which no command writes
        mute(sys.stdout.fileno())
        warn(f"standard output: {error.strerror}")
        sys.exit(BAD_INPUT)


for _module in COMMANDS:
    app.command(_module.__name__.rpartition(".")[2], epilog=_module.EPILOG)(_module.command)
