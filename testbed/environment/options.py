"""The options of `reset`, and one line for what is none of them."""

from collections.abc import Iterable, Mapping
from typing import Any, NamedTuple

from asp.language import Literal, suggestion
from testbed.environment.rules import ResetOptionError, UnknownOptionError


class Options(NamedTuple):
    """How a game is to begin: the literals of its state, if given, and an id for percepts."""

    initial: tuple[Literal, ...] | None = None
    trial: str = ""


PROBE = "options"
"""A key that PettingZoo's own tests give, and that means nothing."""


def read_options(given: Mapping[str, Any] | None) -> Options:
    """The options of `reset(options=...)`.

    Raises:
        UnknownOptionError: for a key that means nothing.
        ResetOptionError: for what is no mapping, and a value of another type.
    """
    if given is None:
        return Options()
    if not isinstance(given, Mapping):
        raise ResetOptionError(f"reset: options should be a dictionary, not {given!r}")
    for key in given:
        if key not in (*Options._fields, PROBE):
            near = suggestion(str(key), Options._fields)
            raise UnknownOptionError(f"reset: {key!r} is not an option; {near}")
    return Options(_literals(given.get("initial")), _id(given.get("trial", "")))


def _literals(given: object) -> tuple[Literal, ...] | None:
    """What they are is for the world to say, which has the words of the domain."""
    if given is None:
        return None
    if isinstance(given, Iterable) and not isinstance(given, str | bytes | Mapping):
        return tuple(given)
    raise ResetOptionError(f"reset: initial should be a list of literals, not {given!r}")


def _id(given: object) -> str:
    if isinstance(given, str):
        return given
    raise ResetOptionError(f"reset: trial should be text, not {given!r}")
