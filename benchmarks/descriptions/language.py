"""What is outside of the language is refused, each mistake in one line with its place."""

import re
from pathlib import Path

from typer.testing import CliRunner

from asp import SourceError, parse_description
from benchmarks.sheets import DisagreementError
from testbed.cli import app

_BAD_INPUT = 2


def mistakes(text: str, file: Path) -> int:
    """How many mistakes a text has; a command has to tell of each, when the text is in a file."""
    try:
        parse_description(text, str(file))
    except SourceError as error:
        _check_refusal(text, file, len(error.all))
        return len(error.all)
    return 0


def _check_refusal(text: str, file: Path, number: int) -> None:
    file.write_text(text, encoding="utf-8")
    told = CliRunner().invoke(app, ["translate", str(file)])
    lines = told.stderr.splitlines()
    placed = [line for line in lines if re.match(rf"{re.escape(str(file))}:\d+:\d+: .", line)]
    if told.exit_code != _BAD_INPUT or len(lines) != number or placed != lines:
        raise DisagreementError(f"refused with the code {told.exit_code}: {told.output}")
