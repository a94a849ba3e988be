"""Where a key stands, what is wrong with its value, and the lines that say so."""

import re
from collections.abc import Collection, Iterable, Iterator, Sequence
from functools import cached_property
from pathlib import Path

import yaml

from asp.language import Literal, Signature, suggestion
from testbed.config.models import ExperimentConfig
from testbed.config.values import NONE


class ConfigError(ValueError):
    """A wrong configuration: `lines` holds one line an error, each with its place."""

    def __init__(self, lines: Sequence[str]) -> None:
        super().__init__("\n".join(lines))
        self.lines = tuple(lines)


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
        self._overridden = [tuple(map(str, parsed(key))) for key in overridden]

    def of(self, key: Key) -> str:
        """`FILE:LINE: KEY`, or as in `command line: KEY` for an overridden one."""
        if self.is_overridden(key):
            return f"{self.elsewhere}: {dotted(key)}"
        parts = tuple(map(str, key))
        known = (self._lines.get(parts[:number]) for number in range(len(parts), 0, -1))
        line = next(filter(None, known), "")
        return ": ".join(filter(None, [f"{self.file}:{line}".removesuffix(":"), dotted(key)]))

    def is_overridden(self, key: Key) -> bool:
        """Whether the value, or a part of it, does not come from the file."""
        parts = tuple(map(str, key))
        given = filter(None, self._overridden if parts else ())
        return any(own[: len(parts)] == parts[: len(own)] for own in given)

    @cached_property
    def _lines(self) -> dict[tuple[str, ...], int]:
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


Finding = tuple[Key, str]
"""A key, and one line that says what is wrong with its value."""

FLUENTS = ("inertial", "defined")
"""The kinds of symbols that are fluents."""


def unknown_atom(
    text: Literal, signature: Signature, kinds: Collection[str], what: str
) -> str | None:
    """What is wrong with a ground atom that is none of these kinds, and what is right, if so."""
    symbols = {name: own for name, own in signature.symbols.items() if own.kind in kinds}
    name, values = text.name, text.arguments
    if name not in symbols:
        return f"no {what} '{name}'; {suggestion(name, symbols)}"
    sorts = [signature.sorts[sort.name] for sort in symbols[name].sorts]
    example = Literal.of(name, (members[0] for members in sorts))
    if len(values) != len(sorts):
        return f"{name} takes {len(sorts)} arguments, as in {example}"
    for value, members in zip(values, sorts, strict=True):
        if value not in members:
            return f"'{value}' in {text} is not known there; {suggestion(value, members)}"
    return None if text.is_positive else f"{text} has a sign; write it as in {example}"


OF_THE_DOMAIN = ("goal", "initial", "scenarios", "scenario_settings", "script", "observability")
"""What is said in the words of a domain."""


def lines_of(findings: Sequence[Finding], places: Places) -> list[str]:
    return [f"{places.of(key)}: {message}" for key, message in findings]


def without_left_out(findings: Sequence[Finding], places: Places) -> list[Finding]:
    """Without unknown scenarios that have settings in the file, where `scenarios` is overridden."""
    if not places.is_overridden(("scenarios",)):
        return list(findings)

    def is_left_out(key: Key) -> bool:
        return key[0] == "scenario_settings" and len(key) == 2 and not places.is_overridden(key)

    return [(key, message) for key, message in findings if not is_left_out(key)]


def lines_of_the_domain(
    config: ExperimentConfig, findings: list[Finding], places: Places, scenarios: Sequence[str]
) -> list[str]:
    """Lines of what the domain does not know; one for all that was written for another domain.

    `scenarios` are those of the domain.
    """
    # What would fit this domain by chance is named, too: it was not meant for it.
    written = [key for key in OF_THE_DOMAIN if _is_written(key, config)]
    foreign = {key: key for key in written if not places.is_overridden((key,))}
    if "scenarios" in foreign and not scenarios:
        foreign["scenarios"] += f" (it has none: {NONE})"
    return _of_another("domain", foreign.values(), findings, places)


def _is_written(key: str, config: ExperimentConfig) -> bool:
    """Whether the configuration says something; settings of a scenario left out say nothing."""
    if key == "scenario_settings" and config.scenarios:
        return not config.scenario_settings.keys().isdisjoint(config.scenarios)
    return bool(getattr(config, key))


def lines_of_the_map(findings: list[Finding], places: Places) -> list[str]:
    """Lines of what a map does not know; one for all that was written for other levels."""
    foreign = {
        dotted(key[:2]) if key[0] == "draw" else str(key[0]): message.partition(";")[0]
        for key, message in reversed(findings)
        if not places.is_overridden(key)
    }
    wanted = [f"{key} ({message})" for key, message in reversed(foreign.items())]
    return _of_another("refinement", wanted, findings, places)


def _of_another(
    key: str, foreign: Iterable[str], findings: list[Finding], places: Places
) -> list[str]:
    own = [(at, message) for at, message in findings if places.is_overridden(at)]
    if len(own) == len(findings) or not places.is_overridden((key,)):
        return lines_of(findings, places)
    wanted = f"{places.file} is about another domain; with this one give also {', '.join(foreign)}"
    return [f"{places.of((key,))}: {wanted}", *lines_of(own, places)]
