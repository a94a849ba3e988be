"""What is kept of what was used last: never more than the bound, and the same answers."""

from __future__ import annotations

from collections.abc import Callable

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from asp.language import parse_description, read_domain
from asp.reasoning.planning import Encoding, IncrementalPlanner
from asp.reasoning.planning import incremental as plans
from asp.reasoning.planning import shortest as shared
from asp.reasoning.planning.large import search
from asp.reasoning.planning.large.search import Spaces
from asp.solving import Recent
from benchmarks.offices import office

OFFICE = read_domain("office")[1]
# A fluent that is defined by others: no search tells the length of a plan, all are tried.
SHELVED = OFFICE.replace(
    "inertial locked(secure_room).", "inertial locked(secure_room).\n  defined shelved."
).replace("  % State constraints.", "  shelved if loc(book1, library).\n")
GOALS = (
    ("loc(book1,office1)",),
    ("loc(rob1,office2)",),
    ("loc(book2,kitchen)",),
    ("loc(book1,library)", "loc(rob1,office2)"),
    ("loc(book1,office1)",),
)


@given(most=st.integers(1, 4), keys=st.lists(st.integers(0, 6)))
@settings(max_examples=200)
def test_the_last_ones_used_are_kept_and_others_made_anew(most: int, keys: list[int]) -> None:
    recent: Recent[int, object] = Recent(most)
    made: list[int] = []

    def maker(key: int) -> Callable[[], object]:
        def make() -> object:
            made.append(key)
            return key

        return make

    for number, key in enumerate(keys):
        before = len(made)
        assert recent.get(key, maker(key)) == key
        others = list(dict.fromkeys(reversed(keys[:number])))
        assert (len(made) == before) == (key in others[:most])
        assert len(recent) <= most


@pytest.mark.parametrize("text", [OFFICE, SHELVED])
def test_with_little_kept_plans_are_the_same(text: str, monkeypatch: pytest.MonkeyPatch) -> None:
    assert text == OFFICE or "shelved if" in text
    ample = IncrementalPlanner(text, "office.al")
    monkeypatch.setattr(plans, "MOST_PARTS", 1)
    monkeypatch.setattr(shared, "MOST_LENGTHS", 1)
    scarce = IncrementalPlanner(text, "office.al")
    state = frozenset(["loc(rob1,kitchen)", "loc(book1,kitchen)", "loc(book2,office1)"])
    for goal in GOALS:
        plan = ample.shortest(state, goal, 8)
        assert scarce.shortest(state, goal, 8) == plan
        assert plan is not None
        assert scarce.succeeds(state, goal, plan)
        assert not scarce.succeeds(state, goal, plan[:-1])
        assert len(scarce._parts) == 1
    (part,) = scarce._parts._kept.values()
    assert len(part._planning) <= 1
    assert len(part._following) <= 1


def test_with_one_space_kept_bounds_are_the_same(monkeypatch: pytest.MonkeyPatch) -> None:
    encoding = Encoding(parse_description(office(books=3, rooms=8), "office.al"))
    ample = Spaces(encoding, 2_000)
    monkeypatch.setattr(search, "MOST_SPACES", 1)
    scarce = Spaces(encoding, 2_000)
    state = frozenset(["loc(rob1,library)", *(f"loc(book{n},office1)" for n in (1, 2, 3))])
    goals = [[f"loc(book{n},library)" for n in some] for some in ((1,), (2,), (1, 2, 3), (1,))]
    for goal in goals:
        expected, found = ample.bounds(state, goal), scarce.bounds(state, goal)
        assert expected is not None
        assert found is not None
        length = expected.least(60, lambda _: None)
        assert found.least(60, lambda _: None) == length
        assert length is not None
        assert found.steps(length, lambda _: None) == expected.steps(length, lambda _: None)
        assert len(scarce._kept) == 1
    assert len(ample._kept) > 1
