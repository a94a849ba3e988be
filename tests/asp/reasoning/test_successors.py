"""One transition at a time, against the transition diagram: every state and attempt of the cart."""

from collections.abc import Iterable, Iterator
from itertools import combinations, product
from pathlib import Path

import pytest

from asp.language import Literal, parse_description
from asp.reasoning import Transitions, knowledge
from asp.reasoning.diagnosis import Happening
from asp.reasoning.diagnosis.history import Problem, Record
from asp.reasoning.diagnosis.smallest_explanations import MANY, Question, SmallestExplanations
from asp.translation import translate
from testbed.world import world_of

TEXT = (Path(__file__).parent / "cart.al").read_text(encoding="utf-8")
CART = parse_description(TEXT, "cart.al")
WORLD = world_of(CART)
EVENTS = tuple(CART.exogenous_actions)
PLENTY = 10_000


@pytest.fixture(scope="module")
def transitions() -> Transitions:
    return Transitions(translate(TEXT, "cart.al"), CART.fluents)


@pytest.fixture(scope="module")
def explanations() -> SmallestExplanations:
    return SmallestExplanations(knowledge("cart", TEXT), begins=False)


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
def test_outcomes_are_all_that_may_have_happened(
    explanations: SmallestExplanations, size: int, failing: bool
) -> None:
    for state, attempt, reported in _cases():
        expected = list(_outcomes(state, attempt, reported, size))
        if failing and attempt is not None and size > 0:  # it was not executed, which is one more
            expected += (
                (after, took_effect, unobserved, distrusted | {attempt})
                for after, took_effect, unobserved, distrusted in _outcomes(
                    state, None, reported, size - 1
                )
            )
        found = []
        for took_effect in (False, True) if attempt is not None else (False,):
            done = None if attempt is None else (attempt, took_effect)
            question = _question(
                explanations, state, Record((), done, reported, None, failing), size
            )
            answers, more = question.all(size, None, PLENTY)
            assert not more or question.given is None  # an action that is impossible everywhere
            found += (
                (after, took_effect, *map(_actions, (e.unobserved, e.distrusted)))
                for e, after in answers
            )
        assert len(found) == len(expected)
        assert set(found) == set(expected)


def _question(
    explanations: SmallestExplanations, state: int, record: Record, size: int
) -> Question:
    problem = Problem((), {0: record}, step=1, since=0 if size >= 0 else 1)
    return explanations.outcomes(problem, MANY).starting(_true(state))


def _outcomes(
    state: int, attempt: str | None, reported: tuple[str, ...], size: int
) -> Iterator[tuple[frozenset[str], bool, frozenset[str], frozenset[str]]]:
    """With size -1 nothing happened but what was attempted."""
    for distrusted in _subsets(reported) if size >= 0 else [reported]:
        believed = tuple(event for event in reported if event not in distrusted)
        others = tuple(event for event in EVENTS if event not in reported)
        for unobserved in _subsets(others) if size >= 0 else [()]:
            if size < 0 or len(unobserved) + len(distrusted) <= size:
                for after, took_effect in _next(state, attempt, (*believed, *unobserved)):
                    yield after, took_effect, frozenset(unobserved), frozenset(distrusted)


def _actions(happenings: Iterable[Happening]) -> frozenset[str]:
    return frozenset(happening.action for happening in happenings)


def test_more_outcomes_than_are_asked_for_are_told(explanations: SmallestExplanations) -> None:
    question = _question(explanations, next(iter(WORLD.initial_states())), Record(), 1)
    every, more = question.all(1, None, PLENTY)
    assert not more
    assert question.all(1, None, len(every)) == (every, False)
    fewer, more = question.all(1, None, len(every) - 1)
    assert (len(fewer), more) == (len(every) - 1, True)


SEALED = """
statics
  sealed.
fluents
  inertial open.
  inertial leaking.
  defined  quiet.
actions
  exogenous knock.
facts
  sealed.
laws
  quiet if -open.
  -leaking if sealed.
  knock causes open.
"""
"""Nothing ever leaks: the solver drops the atoms that say so, and knows them by no literal."""


def test_what_statics_rule_out_is_false_in_every_state() -> None:
    known = knowledge("sealed", SEALED)
    transitions = Transitions(known.program, known.description.fluents)
    assert transitions.after(frozenset({"quiet"}), None, ()) == ({"quiet"}, False)
    assert transitions.after(frozenset({"open"}), None, ()) == ({"open"}, False)
    assert transitions.outcomes(frozenset({"quiet"}), [Literal.parse("knock")]) == {
        frozenset({"open"})
    }
