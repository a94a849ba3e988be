"""Run a configuration."""

from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from testbed.cli.common import Config, Overrides, Swept, examples, input_errors, refuse
from testbed.text import warn

if TYPE_CHECKING:
    from testbed.experiment.shard import Shard

EPILOG = examples(
    "testbed run quickstart",
    "testbed run office limit=5 robots=[intentional] --workers 2",
    "testbed run office limit=5 -m adversary.strategy=random adversary.rate=0:0.4:0.1",
    "testbed run office --out runs/office --resume --retry-failed",
)


def command(
    config: Config,
    overrides: Overrides = None,
    sweep: Swept = False,
    out: Annotated[
        Path | None, typer.Option(help="Run folder; without it runs/NAME, numbered if taken.")
    ] = None,
    workers: Annotated[
        int | None,
        typer.Option(
            min=1,
            help="Processes that play trials; without it one per core, but at most one per "
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
    retry_failed: Annotated[
        bool,
        typer.Option(
            "--retry-failed",
            help="With --resume: play trials again that ended in error or without a robot.",
        ),
    ] = False,
    shard: Annotated[
        str | None,
        typer.Option(
            metavar="I/N",
            help="Play only the I-th of N parts of the trials; `testbed merge` makes them one run.",
        ),
    ] = None,
    quiet: Annotated[bool, typer.Option("--quiet", help="Say nothing but errors.")] = False,
) -> None:
    """Run every trial of a configuration and print a table of what came out."""
    from testbed.cli.loading import load

    if retry_failed and not resume:
        refuse(["--retry-failed: needs --resume; it plays trials of a run folder again"])
    part = _shard(shard)
    with input_errors():
        loaded = load(config, overrides or [], sweep)
        if not quiet:
            warn(f"preparing {loaded.name}: statistics, the plan of its trials, robots")
        from testbed.cli.session import run_session

        code = run_session(loaded, out, workers, resume, quiet, retry_failed, part)
    raise typer.Exit(code)


def _shard(text: str | None) -> "Shard | None":
    from testbed.experiment.shard import Shard

    try:
        return None if text is None else Shard.parse(text)
    except ValueError as error:
        refuse([f"--shard: '{text}' {error}"])
