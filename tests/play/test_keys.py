"""Keys of a real pseudo-terminal, however the bytes of them come."""

import os
import termios
from collections.abc import Iterator, Sequence

import pytest

from testbed.play.keys import (
    BACKSPACE,
    CLOSED,
    DOWN,
    END,
    ENTER,
    HOME,
    PAGE_DOWN,
    PAGE_UP,
    UP,
    Keys,
)

TYPED = {
    b"\x1b[A": UP,
    b"\x1bOB": DOWN,
    b"\x1b[5~": PAGE_UP,
    b"\x1b[6~": PAGE_DOWN,
    b"\x1b[H": HOME,
    b"\x1b[4~": END,
    b"\n": ENTER,
    b"\x7f": BACKSPACE,
    b"\x04": CLOSED,
    b"7": "7",
    b"q": "q",
}
PASSED_OVER = [b"\x1b", b"\x1b[1;5D", b"\xc3\xa4", b"\x01"]


@pytest.fixture
def ends() -> Iterator[tuple[int, int]]:
    """The ends of a pseudo-terminal: the person's, and the program's."""
    person, program = os.openpty()
    yield person, program
    os.close(person)
    os.close(program)


def _read(keys: Keys, number: int) -> Sequence[str]:
    return [keys.read() for _ in range(number)]


def test_each_key_is_read(ends: tuple[int, int]) -> None:
    person, program = ends
    with Keys(program) as keys:
        os.write(person, b"".join(TYPED))
        assert _read(keys, len(TYPED)) == [*TYPED.values()]


@pytest.mark.parametrize("other", PASSED_OVER)
def test_what_is_no_key_is_passed_over(ends: tuple[int, int], other: bytes) -> None:
    person, program = ends
    with Keys(program) as keys:
        os.write(person, other + b"\x1b[B1")
        assert _read(keys, 2) == [DOWN, "1"]


def test_the_terminal_is_as_before_afterwards(ends: tuple[int, int]) -> None:
    _, program = ends
    before = termios.tcgetattr(program)

    def interrupted() -> None:
        with Keys(program):
            assert termios.tcgetattr(program) != before
            raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        interrupted()
    assert termios.tcgetattr(program) == before
