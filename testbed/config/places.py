"""Where a key stands: the line of the YAML file, or where overrides are given."""

from __future__ import annotations

import re
from collections.abc import Sequence
from functools import cached_property
from pathlib import Path

import yaml

Key = tuple[str | int, ...]
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
    """Says where the value of a key came from; `elsewhere` names what gave the overridden ones."""

    def __init__(
        self, file: str | Path, text: str, overridden: Sequence[str], elsewhere: str
    ) -> None:
        self.file = str(file)
        self.elsewhere = elsewhere
        self._text = text
        self._overridden = tuple(overridden)

    def of(self, key: Key) -> str:
        """`FILE:LINE: KEY`, or as in `command line: KEY` for an overridden one."""
        name = dotted(key)
        if self.is_overridden(key):
            return f"{self.elsewhere}: {name}"
        line = self._line(key)
        where = self.file if line is None else f"{self.file}:{line}"
        return f"{where}: {name}" if name else where

    def is_overridden(self, key: Key) -> bool:
        """Whether the value, or a part of it, does not come from the file."""
        return any(_covers(given, key) for given in self._overridden)

    @cached_property
    def _root(self) -> yaml.Node | None:
        return _compose(self._text)

    def _line(self, key: Key) -> int | None:
        node, line = self._root, None
        for part in key:
            found = _child(node, part)
            if found is None:
                return line
            node, line = found
        return line


def _compose(text: str) -> yaml.Node | None:
    # The two implementations of YAML differ about tabs; the text was accepted by the fast one.
    loader = getattr(yaml, "CSafeLoader", yaml.SafeLoader)
    try:
        return yaml.compose(text, Loader=loader)
    except yaml.YAMLError:
        return None


def _covers(given: str, key: Key) -> bool:
    """Whether one of the two keys leads to the other."""
    parts = parsed(given)
    shared = min(len(parts), len(key))
    return shared > 0 and [*map(str, key[:shared])] == [*map(str, parts[:shared])]


def _child(node: yaml.Node | None, part: str | int) -> tuple[yaml.Node, int] | None:
    if isinstance(node, yaml.MappingNode):
        for name, value in node.value:
            if name.value == str(part):
                return value, name.start_mark.line + 1
    if isinstance(node, yaml.SequenceNode) and isinstance(part, int) and part < len(node.value):
        item = node.value[part]
        return item, item.start_mark.line + 1
    return None
