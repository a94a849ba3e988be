"""The statements of the theories one by one, and a theory's text with one of them left out."""

from collections.abc import Iterator
from dataclasses import dataclass
from importlib.resources import files
from itertools import takewhile

from asp.solving import theory

REDUNDANT = "% redundant: "
"""A comment right above a statement that only saves time: what follows it says why."""

_DERIVES_NOTHING = ("#show", "#const", "#defined", "#program")


@dataclass(frozen=True)
class Statement:
    """A rule of a theory: its name, the line it begins in, its text, why it is redundant or ""."""

    theory: str
    line: int
    text: str
    redundant: str = ""

    @property
    def key(self) -> str:
        """`THEORY:LINE`"""
        return f"{self.theory}:{self.line}"


def theories() -> list[str]:
    """The names of all theories."""
    stored = files("asp").joinpath("theories").iterdir()
    return sorted(file.name.removesuffix(".lp") for file in stored if file.name.endswith(".lp"))


def statements(name: str) -> Iterator[Statement]:
    """The statements of a theory that can be left out, in order.

    Each begins a line of its own; the lines it goes on in are indented.
    """
    lines = theory(name).splitlines()
    for number, line in enumerate(lines):
        if line and not line.startswith((" ", "%", *_DERIVES_NOTHING)):
            text = " ".join(part.strip() for part in _lines_from(lines, number))
            yield Statement(name, number + 1, text, _reason(lines[:number]))


def without(name: str, line: int) -> str:
    """A theory's text with blank lines for the statement that begins in this line, from 1.

    Raises ValueError where none does.
    """
    if line not in {statement.line for statement in statements(name)}:
        raise ValueError(f"no rule begins in line {line} of {name}.lp")
    lines = theory(name).splitlines()
    size = len(_lines_from(lines, line - 1))
    lines[line - 1 : line - 1 + size] = [""] * size
    return "\n".join([*lines, ""])


def _lines_from(lines: list[str], number: int) -> list[str]:
    return [lines[number], *takewhile(lambda line: line.startswith(" "), lines[number + 1 :])]


def _reason(above: list[str]) -> str:
    """What the comment right above says from `redundant:` on."""
    comment = list(takewhile(lambda line: line.startswith("%"), reversed(above)))[::-1]
    marked = [number for number, line in enumerate(comment) if line.startswith(REDUNDANT)]
    if not marked:
        return ""
    told = [comment[marked[-1]].removeprefix(REDUNDANT), *comment[marked[-1] + 1 :]]
    return " ".join(line.removeprefix("% ") for line in told)
