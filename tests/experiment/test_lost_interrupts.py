"""A signal that comes where Python loses what is raised: in destructors and in other callbacks."""

import os
import signal
import sys
import weakref
from collections.abc import Callable
from contextlib import suppress
from threading import Event

import pytest

from testbed.experiment.interrupts import SIGNALS, stoppable

LONG_S = 30.0
"""Less than the guard waits for the end."""


class Stopped:
    """An object that is destroyed when the signal comes."""

    def __init__(self, number: signal.Signals) -> None:
        self.number = number

    def __del__(self) -> None:
        os.kill(os.getpid(), self.number)


class Slow(Stopped):
    """One in whose destructor another is destroyed, so that the signal is lost twice."""

    def __del__(self) -> None:
        Stopped(self.number)
        Event().wait(LONG_S)


class Plain:
    """Something with a weak reference to it."""


def _called_back(number: signal.Signals) -> None:
    own = Plain()
    _kept = weakref.ref(own, lambda _: os.kill(os.getpid(), number))
    del own


@pytest.mark.parametrize("number", SIGNALS)
@pytest.mark.parametrize("lose", [Stopped, Slow, _called_back])
def test_a_signal_that_was_lost_comes_again(
    lose: Callable[[signal.Signals], object],
    number: signal.Signals,
    capsys: pytest.CaptureFixture[str],
) -> None:
    hook = sys.unraisablehook
    arrived = []
    with stoppable("too late", quiet=True):
        try:
            lose(number)
            Event().wait(LONG_S)
        except KeyboardInterrupt:
            arrived.append(number)
            os.kill(os.getpid(), number)  # another one does not disturb the ending
            Event().wait(0.01)
    assert arrived == [number]
    assert sys.unraisablehook is hook
    assert capsys.readouterr().err == ""


class Wrong:
    """An object whose destructor fails for another reason."""

    def __del__(self) -> None:
        raise LookupError


def test_what_else_is_lost_is_told_as_before(monkeypatch: pytest.MonkeyPatch) -> None:
    told: list[object] = []
    monkeypatch.setattr(sys, "unraisablehook", lambda lost: told.append(lost.exc_type))
    with stoppable("too late", quiet=True):
        Wrong()
    assert told == [LookupError]


@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGTERM])
def test_nothing_comes_after_the_block(number: signal.Signals) -> None:
    before = [signal.getsignal(own) for own in SIGNALS], sys.unraisablehook
    for _ in range(30):
        with suppress(KeyboardInterrupt), stoppable("too late", quiet=True):
            Stopped(number)
        assert ([signal.getsignal(own) for own in SIGNALS], sys.unraisablehook) == before
    Event().wait(0.3)
