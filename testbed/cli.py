"""The command line: run, check, robot, report, export, replay, translate.

Exit codes: 0 done; 1 trials ended in error; 2 bad input; 130 interrupted or terminated.
"""

# Imports that only one command needs are made in it: a robot's process is to be there quickly,
# and statistics alone take longer to import than it takes to start.
# ruff: noqa: PLC0415

from __future__ import annotations

import importlib.metadata
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Annotated, NoReturn

import typer

DONE, FAILED, BAD_INPUT = 0, 1, 2

app = typer.Typer(
    name="testbed",
    no_args_is_help=True,
    add_completion=False,
    pretty_exceptions_enable=False,
    rich_markup_mode=None,
)

Config = Annotated[
    str,
    typer.Argument(metavar="CONFIG", help="A .yaml file, or a packaged name such as quickstart."),
]
Overrides = Annotated[
    list[str] | None,
    typer.Argument(metavar="KEY=VALUE", help="Keys to override, dotted where nested."),
]


def _examples(*lines: str) -> str:
    """The end of a command's help: a line an example (click wraps no paragraph that has a \\b)."""
    return "\n".join(["\b", "Examples:" if len(lines) > 1 else "Example:", *lines])


def _version(wanted: bool) -> None:
    if wanted:
        typer.echo(f"testbed {importlib.metadata.version('intention-testbed')}")
        raise typer.Exit(DONE)


@app.callback()
def common(
    version: Annotated[
        bool,
        typer.Option("--version", callback=_version, is_eager=True, help="Say it, and exit."),
    ] = False,
) -> None:
    """Reasoning robots in a world that others change: run experiments, look into them."""


def main() -> None:
    """Entry point of the distribution."""
    app(prog_name="testbed")


@app.command(
    epilog=_examples(
        "testbed run quickstart",
        "testbed run office limit=5 robots=[intentional] --workers 2",
        "testbed run office --out runs/office --resume",
    )
)
def run(
    config: Config,
    overrides: Overrides = None,
    out: Annotated[
        Path | None, typer.Option(help="Run folder; without it runs/NAME, numbered if taken.")
    ] = None,
    workers: Annotated[
        int | None,
        typer.Option(
            min=1,
            help="Processes that play trials; without it one a core, and one at most for each "
            "50 trials.",
        ),
    ] = None,
    resume: Annotated[
        bool,
        typer.Option(
            "--resume",
            help="Go on with the trials that the folder lacks: that of --out, else the newest of "
            "runs/NAME, runs/NAME-2 and so on.",
        ),
    ] = False,
    quiet: Annotated[bool, typer.Option("--quiet", help="Say nothing but errors.")] = False,
) -> None:
    """Run every trial of a configuration and print a table of what came out."""
    from testbed.experiment.session import run_session

    with _input_errors():
        code = run_session(config, overrides or [], out, workers, resume, quiet)
    raise typer.Exit(code)


@app.command(epilog=_examples("testbed check quickstart scenarios=[5] limits.steps=40"))
def check(config: Config, overrides: Overrides = None) -> None:
    """Validate a configuration and print it as resolved."""
    from testbed.experiment.session import load
    from testbed.experiment.store import config_text

    with _input_errors():
        typer.echo(config_text(load(config, overrides or [])), nl=False)


@app.command(
    epilog="Examples: testbed robot (with a router on this machine: zenohd) | "
    "testbed robot --name arm --connect tcp/192.168.0.7:7447 (with a router or driver there) | "
    "testbed robot --config zenoh.json5"
)
def robot(
    connect: Annotated[
        str | None,
        typer.Option(
            metavar="ENDPOINT",
            help="Driver or router to serve; the robot ends with it. Without this and --config: "
            "whoever listens at tcp/127.0.0.1:7447, zenoh's usual endpoint, now or later.",
        ),
    ] = None,
    name: Annotated[str, typer.Option(help="Name under which the robot offers itself.")] = "robot",
    config: Annotated[
        Path | None,
        typer.Option(
            metavar="FILE", help="zenoh configuration, JSON5; --connect adds an endpoint to it."
        ),
    ] = None,
) -> None:
    """Serve a robot over zenoh until interrupted."""
    from testbed.experiment.serving import serve_robot

    with _input_errors():
        serve_robot(connect, name, config)


@app.command(epilog=_examples("testbed report runs/quickstart"))
def report(
    folders: Annotated[list[Path], typer.Argument(metavar="DIR...", help="Run folders.")],
) -> None:
    """Make tables, summary.json and report.html again from the stored trials."""
    from testbed.experiment.session import report_again

    with _input_errors():
        for folder in folders:
            report_again(folder)


@app.command(epilog=_examples("testbed export runs/quickstart"))
def export(
    folders: Annotated[list[Path], typer.Argument(metavar="DIR...", help="Run folders.")],
) -> None:
    """Write the stored trials of a run as trials.parquet and trials.csv into its folder."""
    from testbed.experiment.export import export as write

    with _input_errors():
        for folder in folders:
            for path in write(folder):
                typer.echo(path)


@app.command(
    epilog=_examples(
        "testbed replay runs/quickstart", "testbed replay runs/quickstart --trial 107b"
    )
)
def replay(
    folder: Annotated[Path, typer.Argument(metavar="DIR", help="Run folder.")],
    trial: Annotated[
        str | None,
        typer.Option(metavar="ID", help="Id of the trial, or its beginning; without it: a list."),
    ] = None,
) -> None:
    """Tell a trial step by step: world, belief, intention, explanation.

    Without --trial the trials of the run are listed. With it the trial is played again in this
    process; where that differs from the record it says so, and the exit code is 1.
    """
    from testbed.experiment.replay import list_trials
    from testbed.experiment.replay import replay as tell

    with _input_errors():
        if trial is None:
            list_trials(folder, typer.echo)
            return
        as_recorded = tell(folder, trial, typer.echo)
    raise typer.Exit(DONE if as_recorded else FAILED)


@app.command(
    epilog=_examples("testbed translate office -o office.lp", "testbed translate office.fine")
)
def translate(
    source: Annotated[
        str,
        typer.Argument(
            metavar="FILE",
            help="A description (.al), the refinement of one (.fine), or a packaged domain's name.",
        ),
    ],
    output: Annotated[
        Path | None, typer.Option("-o", "--output", metavar="FILE.lp", help="Instead of printing.")
    ] = None,
) -> None:
    """Translate an action description from AL_d to answer set programming.

    Of a refinement it is the program of the refined description with its theory of observation.
    """
    from asp.loading import read_domain
    from asp.refinement import load_refinement
    from asp.translation import translate as translated
    from asp.translation import translate_source

    with _input_errors():
        if source.endswith(".fine"):
            refinement = load_refinement(source)
            program = translate_source(refinement.strong, refinement.strong_signature)
        else:
            program = translated(*reversed(read_domain(source)))
        if output is None:
            typer.echo(program, nl=False)
        else:
            output.write_text(program, encoding="utf-8")


@contextmanager
def _input_errors() -> Iterator[None]:
    """Turn what a user can get wrong into a line an error and the exit code for it."""
    from asp import SourceError
    from testbed.config import ConfigError
    from testbed.experiment.errors import ServingError, StoreError

    try:
        yield
    except SourceError as error:
        _refuse("\n".join(str(mistake) for mistake in error.all))
    except (ConfigError, StoreError, ServingError) as error:
        _refuse(str(error))
    except UnicodeDecodeError as error:
        _refuse(f"not a text file in UTF-8: {error.reason} at byte {error.start}")
    except BrokenPipeError:
        raise
    except OSError as error:
        where = f"{error.filename}: " if error.filename else ""
        _refuse(f"{where}{error.strerror or error}")


def _refuse(message: str) -> NoReturn:
    sys.stdout.flush()
    typer.echo(message, err=True)
    raise typer.Exit(BAD_INPUT)
