"""The clock of reasoning does not count what is done once a process."""

import time
from collections.abc import Iterable, Sequence

import pytest

from asp.kept import search
from asp.kept.clock import preparation, reasoning_clock
from asp.kept.operators import Operator
from asp.kept.plans import Plans
from asp.kept.statesets import Space
from asp.loading import read_domain
from asp.solving import TimeLimitError, time_limit

OFFICE = read_domain("office")[1]
STATE = frozenset(["loc(rob1,library)", "loc(book1,office1)", "loc(book2,office1)"])
SLOW_S = 0.3


@pytest.fixture
def slow_spaces(monkeypatch: pytest.MonkeyPatch) -> list[Space]:
    """The spaces that were made, each of which takes a while."""
    made: list[Space] = []

    def slow(
        sizes: Sequence[int], operators: Iterable[Operator], variables: Sequence[int]
    ) -> Space:
        time.sleep(SLOW_S)
        made.append(Space(sizes, operators, variables))
        return made[-1]

    monkeypatch.setattr(search, "Space", slow)
    return made


def test_the_clock_goes_with_the_time_and_stands_still_inside() -> None:
    began, clock = time.perf_counter(), reasoning_clock()
    time.sleep(0.02)
    with preparation():
        time.sleep(0.05)
    passed = time.perf_counter() - began
    counted = reasoning_clock().since(clock).wall
    assert 0.02 <= counted <= passed - 0.05


def test_nested_it_stands_still_once() -> None:
    before = reasoning_clock()
    with preparation(), preparation():
        time.sleep(0.02)
    assert reasoning_clock().wall >= before.wall


def test_it_stands_still_while_a_space_is_made(slow_spaces: list[Space]) -> None:
    plans = Plans(OFFICE, "office.al")
    began, clock = time.perf_counter(), reasoning_clock()
    assert plans.reachable(STATE, ("loc(book1,library)",))
    passed = time.perf_counter() - began
    counted = reasoning_clock().since(clock).wall
    assert len(slow_spaces) == 1
    assert counted <= passed - SLOW_S


def test_the_limit_of_a_decision_counts_it_and_it_is_made_once(slow_spaces: list[Space]) -> None:
    plans, goal = Plans(OFFICE, "office.al"), ("loc(book1,library)", "loc(book2,library)")
    assert plans.succeeds(STATE, goal, ("move(rob1,office2)",)) is False  # reads and encodes
    with pytest.raises(TimeLimitError), time_limit(SLOW_S / 2):
        plans.shortest(STATE, goal, 20)
    assert len(slow_spaces) == 1
    assert plans.shortest(STATE, goal, 20) == Plans(OFFICE, "office.al").shortest(STATE, goal, 20)
    assert len(slow_spaces) == 2, "one of each"
