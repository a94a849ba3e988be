"""Which explanation is adopted, and when it is kept."""

from collections.abc import Sequence
from itertools import combinations, product

import clingo
import pytest
from clingo import Symbol

from asp import load_description
from asp.solving import fact, first_model, select
from testbed.world import world_of
from tests.asp.reasoning.stories import CART, GATE_OPEN, GOAL, lines
from tests.asp.theories.preferring import ground_story

Event = tuple[int, str]
Events = frozenset[Event]

_KEEP = clingo.Function("keep")


def _only(*events: Event) -> Events:
    return frozenset(events)


def _diagnosis(
    rules: str, now: int, limit: int, ranks: Sequence[Symbol] | None = None
) -> clingo.Control:
    given = [GOAL, rules, f"current_step({now}). explaining({now})."]
    constants = {"n": now, "max_name": 2, "max_len": 2, "max_unobserved": limit}
    return ground_story(CART, "diagnosis", given, constants, ranks)


def _events(model: Sequence[Symbol] | None) -> Events | None:
    if model is None:
        return None
    return frozenset((step.number, str(action)) for action, step in select(model, "unobserved", 2))


def _adopt(control: clingo.Control, size: int, now: int) -> Events | None:
    return _events(first_model(control, [(fact("number_unobserved", size, now), True)]))


def _every(control: clingo.Control) -> set[Events]:
    control.configuration.solve.models = 0  # type: ignore[union-attr]
    found: set[Events] = set()
    with control.solve(yield_=True) as handle:
        for model in handle:
            events = _events(model.symbols(shown=True))
            assert events is not None
            found.add(events)
    return found


def test_the_latest_of_several_smallest_explanations_is_adopted() -> None:
    control = _diagnosis(lines(GATE_OPEN, "obs(shut,true,3)."), now=3, limit=1)
    assert _every(control) == {_only((step, "shut_gate")) for step in range(3)}
    assert _adopt(control, 1, 3) == _only((2, "shut_gate"))


def test_at_one_step_the_action_declared_first_is_adopted() -> None:
    rules = lines(
        GATE_OPEN, "exogenous_action(slam).", "holds(shut,I+1) :- occurs(slam,I), step(I), I < n."
    )
    rules = lines(rules, "obs(shut,true,2).")
    for first, second in (("slam", "shut_gate"), ("shut_gate", "slam")):
        ranks = [fact("ranks", 2), fact("rank", first, 0), fact("rank", second, 1)]
        assert _adopt(_diagnosis(rules, 2, 1, ranks), 1, 2) == _only((1, first))


def test_the_order_of_explanations_is_latest_event_first_then_declaration() -> None:
    """Against the order spelt out: for each later step first, at it each action in its order."""
    seen = "obs(shut,true,4). obs(at(right),true,4)."
    control = _diagnosis(lines(GATE_OPEN, seen), now=4, limit=2)
    actions = load_description(CART).exogenous_actions
    places = [(step, action) for step in (3, 2, 1, 0) for action in actions]
    every = _every(control)
    assert len(every) == 16  # shutting and pushing, each at one of four steps
    preferred = min(every, key=lambda events: [place not in events for place in places])
    assert _adopt(control, 2, 4) == preferred == _only((3, "shut_gate"), (3, "push(right)"))


def test_the_smallest_explanation_has_as_many_events_as_the_smallest_set_that_works() -> None:
    seen = lines(GATE_OPEN, "obs(at(right),true,1). obs(at(left),true,2). obs(shut,true,2).")
    control = _diagnosis(seen, now=2, limit=4)
    actions = load_description(CART).exogenous_actions
    world = world_of(load_description(CART))
    start = world.state(["at(left)"])

    def explains(events: Events) -> bool:
        states = [start]
        for step in (0, 1):
            now = [action for at, action in events if at == step]
            if not world.executable(states[-1], now):
                return False
            after = world.successors(states[-1], now)
            if len(after) != 1:
                return False
            states += after
        return world.holds(states[1], "at(right)") and world.satisfies(
            states[2], ["at(left)", "shut"]
        )

    places = list(product((0, 1), actions))
    for size in range(5):
        expected = {
            frozenset(events)
            for events in combinations(places, size)
            if explains(frozenset(events))
        }
        found = _adopt(control, size, 2)
        assert found in expected if expected else found is None
    assert _adopt(control, 2, 2) is None
    assert _adopt(control, 3, 2) is not None


def test_an_adopted_explanation_is_kept_while_it_explains_what_is_seen() -> None:
    adopted = "adopted(shut_gate,0)."
    control = _diagnosis(lines(GATE_OPEN, adopted, "obs(shut,true,3)."), now=3, limit=1)
    control.assign_external(_KEEP, True)
    assert _events(first_model(control)) == _only((0, "shut_gate"))
    control.assign_external(_KEEP, False)
    assert _adopt(control, 1, 3) == _only((2, "shut_gate"))


@pytest.mark.parametrize(
    ("adopted", "seen"),
    [
        pytest.param("adopted(shut_gate,0).", "obs(shut,false,3).", id="contradicted"),
        pytest.param(
            "adopted(shut_gate,0).", "obs(shut,true,3). obs(at(right),true,3).", id="not enough"
        ),
        pytest.param("", "obs(shut,true,3).", id="nothing adopted"),
    ],
)
def test_an_adopted_explanation_is_not_kept_where_it_does_not_explain(
    adopted: str, seen: str
) -> None:
    control = _diagnosis(lines(GATE_OPEN, adopted, seen), now=3, limit=2)
    control.assign_external(_KEEP, True)
    assert first_model(control) is None
    control.assign_external(_KEEP, False)
    assert first_model(control) is not None


def test_what_was_adopted_counts_no_more_once_nothing_explains_it() -> None:
    control = _diagnosis(lines(GATE_OPEN, "adopted(shut_gate,0).", "obs(shut,false,3)."), 3, 1)
    assert _adopt(control, 0, 3) == frozenset()
