"""A call that is ended because it takes too long, whatever it would have taken."""

from collections.abc import Callable
from threading import Event

from benchmarks import measuring


def takes_too_long(_seconds: float, _call: Callable[[], object]) -> object | None:
    """In place of `benchmarks.measuring.within`, with a call that never ends."""
    return measuring.within(0.01, Event().wait)
