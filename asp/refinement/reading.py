"""Refinements in files: the text of one names the description that it refines."""

from __future__ import annotations

from importlib.resources import files
from pathlib import Path

from asp.language import SourceError, read_domain, read_text
from asp.refinement.language import Refines, parse_fine
from asp.refinement.refinement import Refinement, load

SUFFIX = ".fine"


def load_refinement(name_or_path: str) -> Refinement:
    """The refinement of a file, or of a packaged one by its name (`level.fine`).

    It refines what its `refines` statement names: a packaged domain, or a file beside it. Raises
    SourceError, and FileNotFoundError where there is no such file.
    """
    file, text = read_refinement(name_or_path)
    coarse_file, coarse_text = _coarse(file, text)
    return load(coarse_text, coarse_file, text, file)


def read_refinement(name_or_path: str) -> tuple[str, str]:
    """The file name, for errors, and the text of a refinement. Raises FileNotFoundError."""
    packaged = files("asp").joinpath("domains", name_or_path)
    if "/" not in name_or_path and packaged.is_file():
        return name_or_path, packaged.read_text(encoding="utf-8")
    path = Path(name_or_path)
    if not path.is_file():  # nor can it be where the name has a character that none of a file has
        raise FileNotFoundError(
            f"{name_or_path}: no such refinement; give the path of a {SUFFIX} file or one of "
            f"{', '.join(packaged_refinements())}"
        )
    return str(path), read_text(path)


def packaged_refinements() -> tuple[str, ...]:
    """The names of the refinements that come with this package."""
    entries = files("asp").joinpath("domains").iterdir()
    return tuple(sorted(e.name for e in entries if e.name.endswith(SUFFIX)))


def refined_name(name_or_path: str) -> str | None:
    """What the `refines` statement of a file names, if it has one.

    Raises SourceError, and FileNotFoundError where there is no such file.
    """
    file, text = read_refinement(name_or_path)
    return next((statement.name for statement in parse_fine(text, file).each(Refines)), None)


def _coarse(file: str, text: str) -> tuple[str, str]:
    statements = list(parse_fine(text, file).each(Refines))
    if not statements:
        message = "it does not say which description it refines: begin with 'refines NAME.'"
        raise SourceError(file, 1, 1, message)
    named = statements[0]
    beside = Path(file).parent / named.name
    try:
        return read_domain(str(beside) if beside.is_file() else named.name)
    except FileNotFoundError as error:
        raise SourceError(file, named.place.line, named.place.column, str(error)) from None
