"""The clock of reasoning does not count what is done once a process."""

import time
from collections.abc import Iterable, Sequence

import pytest

from asp.language import read_domain
from asp.reasoning.planning import IncrementalPlanner, Operator
from asp.reasoning.planning.large import search
from asp.reasoning.planning.large.search import Space
from asp.solving import LimitError, Limits, deciding, preparation, reasoning_clock
from tests.literals import parsed

SLOW_S = 3.0
OFFICE = read_domain("office")[1]
STATE = frozenset(parsed(["loc(rob1,library)", "loc(book1,office1)", "loc(book2,office1)"]))


class Clock:
    """Every clock of a process that does nothing but what a test says it does."""

    now = 1000.0

    def __call__(self) -> float:
        return self.now

    def goes_on(self, seconds: float) -> None:
        self.now += seconds


@pytest.fixture
def clock(monkeypatch: pytest.MonkeyPatch) -> Clock:
    """A clock on which no work of this machine shows."""
    clock = Clock()
    for name in ("perf_counter", "process_time", "monotonic"):
        monkeypatch.setattr(time, name, clock)
    return clock


@pytest.fixture
def slow_spaces(monkeypatch: pytest.MonkeyPatch, clock: Clock) -> list[Space]:
    """The spaces that were made, each of which takes a while."""
    made: list[Space] = []

    def slow(sizes: Sequence[int], operators: Iterable[Operator]) -> Space:
        clock.goes_on(SLOW_S)
        made.append(Space(sizes, operators))
        return made[-1]

    monkeypatch.setattr(search, "Space", slow)
    return made


def test_the_clock_goes_with_the_time_and_stands_still_inside(clock: Clock) -> None:
    before = reasoning_clock()
    clock.goes_on(2.0)
    with preparation():
        clock.goes_on(5.0)
    assert reasoning_clock().since(before) == pytest.approx((2.0, 2.0, 5.0), abs=1e-6)


def test_nested_it_stands_still_once(clock: Clock) -> None:
    before = reasoning_clock()
    with preparation():
        clock.goes_on(1.0)
        with preparation():
            clock.goes_on(2.0)
    assert reasoning_clock().since(before) == pytest.approx((0.0, 0.0, 3.0), abs=1e-6)


def test_it_stands_still_while_a_space_is_made(slow_spaces: list[Space]) -> None:
    plans = IncrementalPlanner(OFFICE, "office.al")
    before = reasoning_clock()
    assert plans.reachable(STATE, parsed(["loc(book1,library)"]))
    assert len(slow_spaces) == 1
    assert reasoning_clock().since(before).wall == pytest.approx(0.0, abs=1e-6)


def test_the_limit_of_a_decision_counts_it_and_it_is_made_once(slow_spaces: list[Space]) -> None:
    plans = IncrementalPlanner(OFFICE, "office.al")
    goal = parsed(["loc(book1,library)", "loc(book2,library)"])
    assert plans.succeeds(STATE, goal, parsed(["move(rob1,office2)"])) is False  # reads and encodes
    with pytest.raises(LimitError), deciding(Limits(SLOW_S / 2)):
        plans.shortest(STATE, goal, 20)
    assert len(slow_spaces) == 1
    another = IncrementalPlanner(OFFICE, "office.al")
    assert plans.shortest(STATE, goal, 20) == another.shortest(STATE, goal, 20)
    assert len(slow_spaces) == 2, "one of each"
