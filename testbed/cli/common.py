"""What the commands share: exit codes, arguments, the form of their help, errors of input."""

from __future__ import annotations

import sys
from collections.abc import Iterator
from contextlib import contextmanager
from typing import Annotated, NoReturn

import typer

DONE, FAILED, BAD_INPUT = 0, 1, 2

Config = Annotated[
    str,
    typer.Argument(metavar="CONFIG", help="A .yaml file, or a packaged name such as quickstart."),
]
Overrides = Annotated[
    list[str] | None,
    typer.Argument(metavar="KEY=VALUE", help="Keys to override, dotted where nested."),
]


def examples(*lines: str) -> str:
    """The end of a command's help: one line per example (click wraps no paragraph with a \\b)."""
    return "\n".join(["\b", "Examples:" if len(lines) > 1 else "Example:", *lines])


@contextmanager
def input_errors() -> Iterator[None]:
    """Turn what a user can get wrong into one line per error and the exit code for it."""
    from asp.errors import SourceError
    from testbed.config.errors import ConfigError
    from testbed.experiment.errors import ServingError, StoreError, WorkerError

    try:
        yield
    except SourceError as error:
        _refuse("\n".join(str(mistake) for mistake in error.all))
    except (ConfigError, StoreError, ServingError, WorkerError) as error:
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
