"""How probable an event is by two ways of drawing, and what a pair weighs for it."""

from collections import Counter

import pytest

from agents.adversary import AdversaryView, Game, Triggered
from papers.table1.redrawing import Chances, as_stated, passed_on, weight
from testbed.experiment.record import Attempt, Occurrence
from testbed.protocol import NONE
from testbed.world import load_world
from tests.experiment.samples import a_record

WORLD = load_world("office")
STATED, PASSED_ON = as_stated(WORLD, "random"), passed_on(WORLD, "random")
TRIED = 0.92
HOLDING = ["loc(rob1,kitchen)", "in_hand(rob1,book1)", "loc(book1,kitchen)", "loc(book2,office2)"]
LOCKED = ["loc(rob1,kitchen)", "loc(book1,office1)", "loc(book2,office2)", "locked(library)"]
ELSEWHERE = ("kitchen", "office1", "library")


def _equal(chances: Chances, expected: dict[str, float]) -> None:
    rest = 1 - sum(expected.values())
    wanted = {NONE: pytest.approx(rest), **{e: pytest.approx(p) for e, p in expected.items()}}
    assert {event: p for event, p in chances.items() if p > 1e-12 or event == NONE} == wanted


def test_as_stated_a_held_book_that_is_drawn_is_a_draw_in_vain() -> None:
    expected = {f"exo_move(book2,{room})": TRIED / 9 for room in ELSEWHERE}
    expected["exo_lock(library)"] = TRIED / 3
    _equal(STATED(WORLD.state(HOLDING), "move(rob1,library)"), expected)


def test_passed_on_a_held_book_stands_for_the_other() -> None:
    expected = {f"exo_move(book2,{room})": 2 * TRIED / 9 for room in ELSEWHERE}
    expected["exo_lock(library)"] = TRIED / 3
    _equal(PASSED_ON(WORLD.state(HOLDING), "move(rob1,library)"), expected)


def test_a_book_that_is_being_picked_up_stands_for_the_other_too() -> None:
    state = WORLD.state([HOLDING[0], *HOLDING[2:]])
    expected = {f"exo_move(book2,{room})": 2 * TRIED / 9 for room in ELSEWHERE}
    expected["exo_lock(library)"] = TRIED / 3
    _equal(PASSED_ON(state, "pickup(rob1,book1)"), expected)


def test_a_room_that_is_drawn_may_be_impossible_where_the_draw_is_passed_on() -> None:
    state, action = WORLD.state(LOCKED), "unlock(rob1,library)"
    moves = [("book1", "kitchen"), ("book1", "office2")]
    moves += [("book2", "kitchen"), ("book2", "office1")]
    _equal(STATED(state, action), {f"exo_move({b},{r})": TRIED / 6 for b, r in moves})
    _equal(PASSED_ON(state, action), {f"exo_move({b},{r})": TRIED / 9 for b, r in moves})


def test_a_book_behind_a_lock_is_no_reason_to_pass_on() -> None:
    shut = [*LOCKED[:1], "loc(book1,library)", *LOCKED[2:]]
    chances = PASSED_ON(WORLD.state(shut), "unlock(rob1,library)")
    _equal(chances, {f"exo_move(book2,{room})": TRIED / 9 for room in ("kitchen", "office1")})


def test_another_rate_is_in_place_of_the_stated_one() -> None:
    chances = as_stated(WORLD, "random", 0.3)(WORLD.state(HOLDING), "move(rob1,library)")
    assert chances["exo_lock(library)"] == pytest.approx(0.1)


@pytest.mark.parametrize("state", WORLD.initial_states()[::4])
def test_both_are_distributions_over_the_same_events(state: int) -> None:
    for action in WORLD.agent_actions:
        if not WORLD.executable(state, [action]):
            continue
        stated, passed = STATED(state, action), PASSED_ON(state, action)
        assert sum(stated.values()) == pytest.approx(1.0)
        assert min(*stated.values(), *passed.values()) >= 0.0
        assert sum(p * passed.get(e, 0.0) / p for e, p in stated.items()) == pytest.approx(1.0)


@pytest.mark.parametrize(("literals", "action"), [(HOLDING, "move(rob1,library)"), (LOCKED, "x")])
def test_what_is_stated_is_what_the_adversary_draws(literals: list[str], action: str) -> None:
    action = action if action != "x" else "unlock(rob1,library)"
    state = WORLD.state(literals)
    events = [e for e in WORLD.exogenous_actions if WORLD.executable(state, [action, e])]
    view = AdversaryView(1, frozenset(WORLD.true_atoms(state)), action, [NONE, *events])
    actions, drawn = WORLD.exogenous_actions, Counter[str]()
    game = Game(
        scenario="random", goal=(), exogenous_actions=actions, description=WORLD.description
    )
    adversary = Triggered(game, Triggered.Options())
    for seed in range(4000):
        adversary.reset(seed)
        drawn[adversary.act(view)] += 1
    for event, chance in STATED(state, action).items():
        assert drawn[event] / 4000 == pytest.approx(chance, abs=0.03)


def test_a_trial_weighs_by_all_steps_up_to_its_event() -> None:
    actions = [Attempt(2, "move(rob1,library)", True), Attempt(3, "put_down(rob1,book1)", True)]
    record = a_record(initial=HOLDING, actions=actions)
    record.exogenous = [Occurrence(2, "exo_move(book2,kitchen)", False)]
    assert weight(record, WORLD, STATED, PASSED_ON) == pytest.approx(2.0)
    record.exogenous = [Occurrence(2, "exo_lock(library)", False)]
    assert weight(record, WORLD, STATED, PASSED_ON) == pytest.approx(1.0)
    record.exogenous = [Occurrence(3, "exo_move(book2,kitchen)", False)]
    nothing = (1 - TRIED) / (1 - TRIED + TRIED / 3)
    assert weight(record, WORLD, STATED, PASSED_ON) == pytest.approx(nothing * 2.0)
    record.exogenous = []
    assert weight(record, WORLD, STATED, PASSED_ON) == pytest.approx(nothing**2)


def test_each_step_is_weighed_in_the_state_in_which_it_is_taken() -> None:
    """The second one in a state in which the book that the first one picked up is held."""
    record = a_record(initial=[HOLDING[0], *HOLDING[2:]])
    steps = [(2, "pickup(rob1,book1)"), (3, "move(rob1,library)")]
    record.actions = [Attempt(step, action, True) for step, action in steps]
    record.exogenous = [Occurrence(3, "exo_move(book2,kitchen)", False)]
    nothing = (1 - TRIED) / (1 - TRIED + TRIED / 3)
    assert weight(record, WORLD, STATED, PASSED_ON) == pytest.approx(nothing * 2.0)


def test_an_action_that_fails_leaves_the_state_as_it_is() -> None:
    record = a_record(initial=[HOLDING[0], *HOLDING[2:]])
    steps = [(2, "pickup(rob1,book2)", False), (3, "move(rob1,library)", True)]
    record.actions = [Attempt(*step) for step in steps]
    record.exogenous = [Occurrence(3, "exo_move(book2,kitchen)", False)]
    first = PASSED_ON(WORLD.state(record.initial), "pickup(rob1,book2)")[NONE]
    stated = STATED(WORLD.state(record.initial), "pickup(rob1,book2)")[NONE]
    assert weight(record, WORLD, STATED, PASSED_ON) == pytest.approx(first / stated)


def test_what_the_other_law_never_draws_weighs_nothing() -> None:
    record = a_record(initial=HOLDING, actions=[Attempt(2, "move(rob1,library)", True)])
    record.exogenous = [Occurrence(2, "exo_lock(library)", False)]
    assert weight(record, WORLD, STATED, lambda *_: {NONE: 1.0}) == 0.0
