"""What is kept of what was used last: never more than the bound, and the same answers."""

from collections.abc import Callable

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from asp.language import read_domain
from asp.reasoning.planning import IncrementalPlanner
from asp.reasoning.planning import incremental as plans
from asp.solving import Recent
from tests.literals import parsed

OFFICE = read_domain("office")[1]
# A fluent that is defined by others: no search tells the length of a plan, all are tried.
SHELVED = OFFICE.replace(
    "inertial locked(secure_room).", "inertial locked(secure_room).\n  defined shelved."
).replace("  % State constraints.", "  shelved if loc(book1, library).\n")
GOALS = (
    parsed(["loc(book1,office1)"]),
    parsed(["loc(rob1,office2)"]),
    parsed(["loc(book2,kitchen)"]),
    parsed(["loc(book1,library)", "loc(rob1,office2)"]),
    parsed(["loc(book1,office1)"]),
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


def test_what_was_not_used_for_longest_goes_until_there_is_room() -> None:
    recent: Recent[tuple[str, int], object] = Recent(12)
    made: list[tuple[str, int]] = []
    for key in [("a", 2), ("a", 4), ("a", 2), ("b", 3), ("a", 2), ("a", 4)]:
        recent.get(key, lambda key=key: made.append(key), 2 * key[1])  # type: ignore[misc]
        assert recent.weight <= 12
    # a, 4 had to go for b, 3, and came back.
    assert made == [("a", 2), ("a", 4), ("b", 3), ("a", 4)]
    assert recent.weight == 12


def test_what_is_too_heavy_is_kept_alone() -> None:
    recent: Recent[int, object] = Recent(12)
    for weight in (1, 2, 20):
        recent.get(weight, object, weight)
    assert (len(recent), recent.weight) == (1, 20)


@pytest.mark.parametrize("text", [OFFICE, SHELVED])
def test_with_little_kept_plans_are_the_same(text: str, monkeypatch: pytest.MonkeyPatch) -> None:
    assert text == OFFICE or "shelved if" in text
    ample = IncrementalPlanner(text, "office.al")
    monkeypatch.setattr(plans, "MOST_PARTS", 1)
    monkeypatch.setattr(plans, "MOST_LENGTHS", 1)
    scarce = IncrementalPlanner(text, "office.al")
    state = frozenset(parsed(["loc(rob1,kitchen)", "loc(book1,kitchen)", "loc(book2,office1)"]))
    for goal in GOALS:
        plan = ample.shortest(state, goal, 8)
        assert scarce.shortest(state, goal, 8) == plan
        assert plan is not None
        assert scarce.succeeds(state, goal, plan)
        assert not scarce.succeeds(state, goal, plan[:-1])
        assert len(scarce._parts) == 1
    ((part, _),) = scarce._parts._kept.values()
    assert len(part._planning) <= 1
    assert len(part._following) <= 1
