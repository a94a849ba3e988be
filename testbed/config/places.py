"""Where a key stands, what is wrong with its value, and the lines that say so."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path

import yaml

from asp.language import Literal, Signature, unknown_atom
from testbed.world import StateError


class ConfigError(ValueError):
    """A wrong configuration: `lines` holds one line per error, each with its place."""

    def __init__(self, lines: Sequence[str]) -> None:
        super().__init__("\n".join(lines))
        self.lines = tuple(lines)


Key = tuple[str | int, ...]
FLUENTS = ("inertial", "defined")
Finding = tuple[Key, str]
"""A key, and one line that says what is wrong with its value."""
PART = re.compile(r"\[([^\]]*)\]|([^.\[\]]+)")


def dotted(key: Key) -> str:
    """`("limits", "steps")` as `limits.steps`, positions of a list as `[0]`."""
    text = "".join(f"[{part}]" if isinstance(part, int) else f".{part}" for part in key)
    return text.removeprefix(".")


def parsed(text: str) -> Key:
    """A dotted key as its parts: what `dotted` makes text."""
    found = PART.findall(text)
    return tuple(int(index) if index.isdecimal() else index or name for index, name in found)


class Places:
    """Says where the value of a key came from; `elsewhere` names what gave the overridden ones.

    Of the others `beneath` knows it: the places of what was overridden, if that is not a file.
    """

    def __init__(
        self,
        file: Path,
        text: str,
        overridden: Sequence[str],
        elsewhere: str,
        beneath: Places | None = None,
    ) -> None:
        self.file, self._beneath = str(file), beneath
        self.elsewhere = elsewhere
        self._text = text
        self._overridden = [tuple(map(str, parsed(key))) for key in overridden]

    def of(self, key: Key) -> str:
        """`FILE:LINE: KEY`, or as in `command line: KEY` for an overridden one."""
        if self.is_overridden(key):
            return f"{self.elsewhere}: {dotted(key)}"
        if self._beneath is not None:
            return self._beneath.of(key)
        parts = tuple(map(str, key))
        known = (self._number_of.get(parts[:number]) for number in range(len(parts), 0, -1))
        line = next(filter(None, known), "")
        return ": ".join(filter(None, [f"{self.file}:{line}".removesuffix(":"), dotted(key)]))

    def is_overridden(self, key: Key) -> bool:
        """Whether the value, or a part of it, does not come from the file."""
        parts = tuple(map(str, key))
        given = filter(None, self._overridden if parts else ())
        return any(own[: len(parts)] == parts[: len(own)] for own in given)

    def lines(self, findings: Iterable[Finding]) -> list[str]:
        return [f"{self.of(key)}: {message}" for key, message in findings]

    def lines_of_another(
        self, key: str, foreign: Iterable[str], findings: Sequence[Finding]
    ) -> list[str]:
        """The lines; one for all that was written for another domain, if `key` is overridden.

        `foreign` says what that was.
        """
        own = [found for found in findings if self.is_overridden(found[0])]
        if len(own) == len(findings) or not self.is_overridden((key,)):
            return self.lines(findings)
        wanted = f"{self.file} is about another domain; with this one give also "
        return [f"{self.of((key,))}: {wanted}{', '.join(foreign)}", *self.lines(own)]

    @cached_property
    def _number_of(self) -> dict[tuple[str, ...], int]:
        # The two implementations of YAML differ about tabs; the fast one has read the text.
        root = yaml.compose(self._text, getattr(yaml, "CSafeLoader", yaml.SafeLoader))
        return dict(_lines_below(root, ()))


def _lines_below(
    node: yaml.Node | None, key: tuple[str, ...]
) -> Iterator[tuple[tuple[str, ...], int]]:
    """The keys of a document, and the positions in its lists, with their lines."""
    inner: list[tuple[str, yaml.Node, yaml.Node]] = []
    if isinstance(node, yaml.MappingNode):
        inner = [(name.value, name, value) for name, value in node.value]
    if isinstance(node, yaml.SequenceNode):
        inner = [(str(index), item, item) for index, item in enumerate(node.value)]
    for name, place, value in inner:
        yield (*key, name), place.start_mark.line + 1
        yield from _lines_below(value, (*key, name))


@dataclass(frozen=True)
class Diction:
    """What literals are given in; `check` raises StateError for those that are in no state."""

    signature: Signature
    check: Callable[[Sequence[Literal]], object]


def unfit_literals(
    key: Key, given: Sequence[Literal] | None, diction: Diction, refusal: str
) -> Iterator[Finding]:
    """Unknown literals and contradictory ones; where there are none, whether a state has all."""
    findings: list[Finding] = []
    for index, literal in enumerate(given or ()):
        unknown = unknown_atom(literal.atom, diction.signature, FLUENTS, "fluent")
        if unknown is not None:
            findings.append(((*key, index), unknown))
        elif given and literal.complement in given[:index]:
            twice = f"contradicts {literal.complement}; keep one of the two"
            findings.append(((*key, index), twice))
    yield from findings
    if given is not None and not findings:
        try:
            diction.check(given)
        except StateError as error:
            yield key, f"{refusal}: {error}"
