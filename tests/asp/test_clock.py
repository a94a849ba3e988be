"""The clock of reasoning does not count what is done once a process."""

import time

from asp.kept.clock import reasoning_clock, standing_still


def test_the_clock_goes_with_the_time_and_stands_still_inside() -> None:
    began, clock = time.perf_counter(), reasoning_clock()
    time.sleep(0.02)
    with standing_still():
        time.sleep(0.05)
    passed = time.perf_counter() - began
    counted = reasoning_clock() - clock
    assert 0.02 <= counted <= passed - 0.05


def test_nested_it_stands_still_once() -> None:
    before = reasoning_clock()
    with standing_still(), standing_still():
        time.sleep(0.02)
    assert reasoning_clock() >= before
