"""What the commands share: exit codes, arguments, the form of their help, errors of input."""

import sys
from collections.abc import Iterable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Annotated, NoReturn

import typer

from testbed.text import mute, plain, warn

DONE, FAILED, BAD_INPUT = 0, 1, 2

Config = Annotated[
    str,
    typer.Argument(metavar="CONFIG", help="A .yaml file, or a packaged name such as quickstart."),
]
Overrides = Annotated[
    list[str] | None,
    typer.Argument(metavar="KEY=VALUE", help="Keys to override, dotted where nested."),
]
Swept = Annotated[
    bool,
    typer.Option(
        "-m",
        "--sweep",
        help="Every combination of overrides with several values, KEY=V1,V2, or a range, "
        "KEY=FIRST:LAST:STEP.",
    ),
]
Domain = Annotated[
    str, typer.Argument(metavar="DOMAIN", help="A description (.al), or a packaged domain's name.")
]
Folder = Annotated[Path, typer.Argument(metavar="DIR", help="Run folder.")]
Folders = Annotated[list[Path], typer.Argument(metavar="DIR...", help="Run folders.")]


def examples(*lines: str) -> str:
    """The end of a command's help: one line per example (click wraps no paragraph with a \\b)."""
    return "\n".join(["\b", "Examples:" if len(lines) > 1 else "Example:", *lines])


def emit(text: str) -> None:
    """Write text that a command is asked for to standard output. Raises OSError, naming it."""
    try:
        sys.stdout.write(text)
        sys.stdout.flush()
    except OSError as error:
        mute(sys.stdout.fileno())
        if isinstance(error, BrokenPipeError):
            raise
        raise OSError(error.errno, error.strerror, "standard output") from error


def say(line: str) -> None:
    """The same of a line, in which nothing steers a terminal."""
    emit(f"{plain(line)}\n")


@contextmanager
def input_errors() -> Iterator[None]:
    """Turn what a user can get wrong into one line per error and the exit code for it."""
    try:
        yield
    except BrokenPipeError:  # the reader of standard output has enough
        raise typer.Exit(DONE) from None
    except (ValueError, RuntimeError, OSError) as error:
        lines = None if isinstance(error, typer.Exit) else _refusal(error)
        if lines is None:
            raise
        refuse(lines)


def _refusal(error: Exception) -> Iterable[str] | None:
    """The lines of an error that is one of the input; None of another."""
    from asp.language import DomainError, SourceError
    from testbed.config import ConfigError
    from testbed.experiment.errors import StoreError, WorkerError
    from testbed.registry import RegistryError

    match error:
        case SourceError():
            return map(str, error.all)
        case ConfigError():
            return error.lines
        case DomainError() | StoreError() | WorkerError() | RegistryError():
            return str(error).split("\n")
        case UnicodeDecodeError():
            return [f"not a text file in UTF-8: {error.reason} at byte {error.start}"]
        case OSError():
            where = f"{error.filename}: " if error.filename else ""
            return [f"{where}{error.strerror or error}"]
    return None


def refuse(lines: Iterable[str]) -> NoReturn:
    """Say what is wrong with the input, and exit."""
    for line in lines:
        warn(line)
    raise typer.Exit(BAD_INPUT)
