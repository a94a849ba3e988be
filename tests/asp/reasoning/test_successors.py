"""One transition at a time, against the transition diagram: every state and attempt of the cart."""

from collections.abc import Iterator
from dataclasses import replace
from itertools import combinations, product
from pathlib import Path

import pytest

from asp.language import parse_description
from asp.reasoning.successors import Branch, Transitions
from asp.translation import translate
from testbed.world import world_of

TEXT = (Path(__file__).parent / "cart.al").read_text(encoding="utf-8")
CART = parse_description(TEXT, "cart.al")
WORLD = world_of(CART)
EVENTS = tuple(CART.exogenous_actions)
PLENTY = 10_000


@pytest.fixture(scope="module")
def transitions() -> Transitions:
    return Transitions(translate(TEXT, "cart.al"), CART.fluents, ())


def _subsets(events: tuple[str, ...]) -> Iterator[tuple[str, ...]]:
    for size in range(len(events) + 1):
        yield from combinations(events, size)


def _cases() -> Iterator[tuple[int, str | None, tuple[str, ...]]]:
    return product(WORLD.initial_states(), (None, *CART.agent_actions), _subsets(EVENTS))


def _true(state: int) -> frozenset[str]:
    return frozenset(WORLD.true_atoms(state))


def _next(
    state: int, attempt: str | None, events: tuple[str, ...]
) -> set[tuple[frozenset[str], bool]]:
    """The attempt takes effect unless an executability condition forbids it in this state."""
    possible = attempt is not None and WORLD.executable(state, (attempt,))
    actions = (*events, attempt) if attempt is not None and possible else events
    return {(_true(after), possible) for after in WORLD.successors(state, actions)}


def test_what_is_attempted_and_reported_leads_where_the_world_says(
    transitions: Transitions,
) -> None:
    found = set()
    for state, attempt, reported in _cases():
        after = transitions.after(_true(state), attempt, reported)
        assert _next(state, attempt, reported) == (set() if after is None else {after})
        found.add(None if after is None else after[1])
    assert found == {None, True, False}


@pytest.mark.parametrize("failing", [False, True])
@pytest.mark.parametrize("size", [-1, 0, 1, 2, 5])
def test_branches_are_all_that_may_have_happened(
    transitions: Transitions, size: int, failing: bool
) -> None:
    for state, attempt, reported in _cases():
        expected = list(_branches(state, attempt, reported, size))
        if failing and attempt is not None and size > 0:  # it was not executed, which is one more
            expected += (
                replace(rest, distrusted=(*rest.distrusted, attempt))
                for rest in _branches(state, None, reported, size - 1)
            )
        found = transitions.branches(_true(state), attempt, reported, size, PLENTY, failing)
        assert found is not None
        assert len(found) == len(expected)
        assert {_plain(branch) for branch in found} == {_plain(branch) for branch in expected}


def _branches(
    state: int, attempt: str | None, reported: tuple[str, ...], size: int
) -> Iterator[Branch]:
    """With size -1 nothing happened but what was attempted."""
    for distrusted in _subsets(reported) if size >= 0 else [reported]:
        believed = tuple(event for event in reported if event not in distrusted)
        others = tuple(event for event in EVENTS if event not in reported)
        for unobserved in _subsets(others) if size >= 0 else [()]:
            if size < 0 or len(unobserved) + len(distrusted) <= size:
                for after, took_effect in _next(state, attempt, (*believed, *unobserved)):
                    yield Branch(after, took_effect, unobserved, distrusted)


def _plain(branch: Branch) -> tuple[frozenset[str], bool, frozenset[str], frozenset[str]]:
    return (
        branch.state,
        branch.took_effect,
        frozenset(branch.events),
        frozenset(branch.distrusted),
    )


def test_more_branches_than_are_asked_for_are_none(transitions: Transitions) -> None:
    state = _true(next(iter(WORLD.initial_states())))
    all_of_them = transitions.branches(state, None, (), 1, PLENTY)
    assert all_of_them is not None
    assert transitions.branches(state, None, (), 1, len(all_of_them)) is not None
    assert transitions.branches(state, None, (), 1, len(all_of_them) - 1) is None
