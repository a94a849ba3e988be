"""Reading a description: text or file in, checked ground description out."""

from __future__ import annotations

from functools import lru_cache
from importlib.resources import files
from pathlib import Path

from asp.language import syntax
from asp.language.checker import check
from asp.language.description import Description
from asp.language.errors import SourceError
from asp.language.grounding import ground_description
from asp.language.parser import parse
from asp.language.signature import Problems, Signature, signature_of
from asp.language.size_limits import check_sizes
from asp.language.stratification import check_cycles

MOST_TEXTS = 32
"""Of how many texts the description is remembered: those that were read last."""


@lru_cache(maxsize=MOST_TEXTS)
def analyse(text: str, file: str = "<text>") -> tuple[syntax.Source, Signature]:
    """Parses and checks a text, each of the last few once.

    Raises SourceError, whose `all` holds every mistake found.
    """
    source = parse(text, file)
    problems = Problems(file)
    signature = signature_of(source, problems)
    check(source, signature, problems)
    problems.raise_first()
    check_sizes(source, signature, problems)
    problems.raise_first()
    check_cycles(source, signature, problems)
    problems.raise_first()
    return source, signature


@lru_cache(maxsize=MOST_TEXTS)
def parse_description(text: str, file: str = "<text>") -> Description:
    """The ground description of an AL_d text. Raises SourceError."""
    source, signature = analyse(text, file)
    return ground_description(source, signature, Path(file).stem)


def load_description(name_or_path: str) -> Description:
    """The description of a file, or of a packaged domain by its bare name (`office`).

    Raises SourceError for a mistake in the text and FileNotFoundError, whose text names the
    packaged domains, where there is no such file.
    """
    file, text = read_domain(name_or_path)
    return parse_description(text, file)


def read_domain(name_or_path: str) -> tuple[str, str]:
    """The file name, for errors, and the text of a domain. Raises FileNotFoundError."""
    packaged = files("asp").joinpath("domains", f"{name_or_path}.al")
    if "/" not in name_or_path and packaged.is_file():
        return f"{name_or_path}.al", packaged.read_text(encoding="utf-8")
    path = Path(name_or_path)
    if not path.is_file():
        raise FileNotFoundError(
            f"{name_or_path}: no such domain; give the path of an .al file or one of "
            f"{', '.join(packaged_domains())}"
        )
    return str(path), read_text(path)


def read_text(path: Path) -> str:
    """The text of a file. Raises SourceError, at its place, for what is not UTF-8, and OSError."""
    try:
        return path.read_text(encoding="utf-8")
    except UnicodeDecodeError as error:
        before = error.object[: error.start]
        line, column = before.count(b"\n") + 1, error.start - before.rfind(b"\n")
        message = f"not a text file in UTF-8: {error.reason}"
        raise SourceError(str(path), line, column, message) from None


def packaged_domains() -> tuple[str, ...]:
    """The bare names of the domains that come with this package."""
    entries = files("asp").joinpath("domains").iterdir()
    return tuple(sorted(e.name.removesuffix(".al") for e in entries if e.name.endswith(".al")))
