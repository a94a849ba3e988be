"""The game at the fine resolution: what may fail, what is shown, when others act."""

from collections import Counter

import numpy as np
import pytest

from asp.domains import level_text
from asp.language import Literal, read_domain
from asp.refinement import Refinement, load
from testbed.environment import (
    Core,
    IllegalActionError,
    Observability,
    Pace,
    RandomStart,
    Rules,
    fine_core,
)
from testbed.protocol import FINISH, NONE, WAIT
from testbed.world import world_of

START = ["fine_loc(rob1,room1_1)", "fine_loc(object1_1,room1_2)"]
GOAL = ("loc(object1,room2)", "-in_hand(rob1,object1)")
TO_2, TO_DOOR = Literal.parse("fine_move(rob1,room1_2)"), Literal.parse("fine_move(rob1,room2_1)")
PICKUP, PUT_DOWN = (
    Literal.parse("fine_pickup(rob1,object1_1)"),
    Literal.parse("fine_put_down(rob1,object1_1)"),
)
HERE = Literal.parse("test_fine_loc(rob1,object1_1,room1_1)")

# An office of two cells a room, the library of which can be locked.
OFFICE_CELLS = """
refines office.
magnify
  room into cell.
components
  kitchen = {kitchen_1, kitchen_2}.
  office1 = {office1_1}.  office2 = {office2_1}.
  library = {library_1}.
counterparts
  next_to. loc. move. exo_move.
facts
  fine_next_to(office1_1, office2_1).  fine_next_to(office2_1, kitchen_1).
  fine_next_to(kitchen_1, kitchen_2).  fine_next_to(kitchen_2, library_1).
tests
  R tests fine_loc(T, C) if robot(R), fine_loc(R, C).
"""


def refinement(*objects: tuple[int, int], rooms: int = 2, columns: int = 2) -> Refinement:
    coarse, fine = level_text(rooms, 1, columns, objects or ((1, 1),))
    return load(coarse, "level.al", fine, "level.fine")


def begin(
    initial: list[str] | None = None,
    pace: Pace = "concrete",
    rules: Rules | None = None,
    **statistics: float,
) -> Core:
    core = fine_core(refinement(), rules or Rules(goal=GOAL, steps=10**6), statistics, pace)
    core.reset(0, initial or START)
    return core


def test_the_robot_may_wait_finish_act_and_test() -> None:
    names = Counter(action.partition("(")[0] for action in begin().robot_actions)
    assert names == {
        WAIT: 1,
        FINISH: 1,
        "fine_move": 4,
        "fine_pickup": 1,
        "fine_put_down": 1,
        "test_fine_loc": 2 * 4,
        "test_fine_in_hand": 1,
    }


def test_a_plan_of_concrete_actions_achieves_a_coarse_goal() -> None:
    core = begin()
    for action in (TO_2, PICKUP, TO_DOOR, PUT_DOWN):
        assert not core.achieved
        core.advance(action)
        assert core.situation.happened
    core.advance(FINISH)
    assert core.situation.ending == "achieved"


def test_the_robot_is_told_whether_its_attempt_took_effect_and_no_more() -> None:
    for chance in (0.0, 1.0):
        core = begin(fine_move=chance)
        core.advance(TO_2)
        percept = core.percept
        assert (percept.attempted, percept.happened, percept.visible) == (TO_2, bool(chance), [])


def test_an_action_fails_as_often_as_the_statistics_say() -> None:
    core = begin(fine_move=0.85)
    came_out = Counter[bool]()
    there_and_back = {True: Literal.parse("fine_move(rob1,room1_1)"), False: TO_2}
    for _ in range(3000):
        is_there = core.world.holds(core.situation.state, Literal.parse("fine_loc(rob1,room1_2)"))
        core.advance(there_and_back[is_there])
        came_out[core.situation.happened is True] += 1
    # 3000 draws at 0.85 have a standard deviation of 20.
    assert came_out[True] == pytest.approx(2550, abs=100)


def test_a_failed_action_changes_nothing_but_the_event_beside_it_does() -> None:
    core = begin(fine_move=0.0)
    core.advance(TO_2, Literal.parse("fine_exo_move(object1_1,room2_2)"))
    assert core.world.satisfies(
        core.situation.state, ["fine_loc(rob1,room1_1)", "fine_loc(object1_1,room2_2)"]
    )


def test_a_test_shows_its_fluent_and_changes_nothing() -> None:
    core = begin(["fine_loc(rob1,room1_1)", "fine_loc(object1_1,room1_1)"])
    before = core.situation.state
    core.advance(HERE)
    assert core.percept.visible == ["fine_loc(object1_1,room1_1)"]
    assert (core.percept.attempted, core.percept.happened) == (HERE, True)
    core.advance(Literal.parse("test_fine_in_hand(rob1,object1_1)"))
    assert core.percept.visible == ["-fine_in_hand(rob1,object1_1)"]
    assert core.situation.state == before


def test_what_a_test_shows_is_true_of_the_state_that_it_leaves() -> None:
    core = begin()
    core.advance(HERE, Literal.parse("fine_exo_move(object1_1,room1_1)"))
    assert core.percept.visible == ["fine_loc(object1_1,room1_1)"]


def test_a_test_in_another_cell_shows_nothing() -> None:
    core = begin()
    core.advance(Literal.parse("test_fine_loc(rob1,object1_1,room1_2)"))
    assert core.percept.visible == []
    assert core.percept.happened is False


def test_a_test_is_wrong_as_often_as_the_statistics_say_but_not_about_the_robot() -> None:
    core = begin(test_fine_loc=0.9)
    shown = Counter[str]()
    for _ in range(2000):
        core.advance(HERE)
        shown.update(core.percept.visible)
    # 2000 draws at 0.9 have a standard deviation of 13.
    assert shown["-fine_loc(object1_1,room1_1)"] == pytest.approx(1800, abs=70)
    assert shown.total() == 2000
    blind = begin(test_fine_loc=0.0)
    blind.advance(Literal.parse("test_fine_loc(rob1,rob1,room1_1)"))
    assert blind.percept.visible == ["fine_loc(rob1,room1_1)"]


def test_a_test_shows_its_outcome_once() -> None:
    core = begin()
    core.advance(HERE)
    core.advance(WAIT)
    assert core.percept.visible == []


@pytest.mark.parametrize(
    ("statistics", "message"),
    [
        ({"move": 0.5}, "no action move; there are fine_move, "),
        ({"fine_move": 1.5}, "1.5 does not"),
    ],
)
def test_statistics_that_are_none_are_refused(statistics: dict[str, float], message: str) -> None:
    with pytest.raises(ValueError, match=message):
        begin(**statistics)


def test_what_others_may_do_is_possible_however_the_action_comes_out() -> None:
    core = begin(fine_move=0.5, fine_pickup=0.5)
    for action in (TO_2, PICKUP, TO_DOOR, HERE):
        legal = core.events(action)
        assert legal == tuple(core.legal_events(action))
        world, state = core.world, core.situation.state
        possible = world.executable(state, (action,)) if action != HERE else False
        ways = [(action,), ()] if possible else [()]
        for event in world.exogenous_actions:
            expected = all(world.executable(state, (*way, event)) for way in ways)
            assert (event in legal) == expected == core.legal(action, event)
            assert (core.why_not(action, event) is None) == expected
        core.advance(action)


def test_an_impossible_event_is_refused_with_the_reason() -> None:
    core = begin()
    before = core.snapshot()
    with pytest.raises(IllegalActionError, match=r"impossible fine_exo_move\(object1_1,room1_2\)"):
        core.advance(HERE, Literal.parse("fine_exo_move(object1_1,room1_2)"))
    assert core.snapshot() == before


def test_at_the_abstract_pace_others_act_only_beside_what_changes_the_coarse_state() -> None:
    at = begin(pace="abstract", fine_move=0.5)
    assert at.events(TO_2) == at.events(HERE) == at.events(TO_DOOR) == (NONE,)
    with pytest.raises(IllegalActionError, match="changes nothing coarse"):
        at.advance(TO_2, Literal.parse("fine_exo_move(object1_1,room2_2)"))
    at = begin(["fine_loc(rob1,room1_2)", "fine_loc(object1_1,room1_2)"], pace="abstract")
    assert set(at.events(TO_DOOR)) == {
        NONE,
        *(f"fine_exo_move(object1_1,{cell})" for cell in ("room1_1", "room2_1", "room2_2")),
    }
    assert at.events(Literal.parse("fine_move(rob1,room1_1)")) == (NONE,)
    assert begin(pace="concrete").events(TO_2) != (NONE,)


@pytest.mark.parametrize(
    ("start", "told"), [("room1_1", True), ("room1_2", False), ("room2_2", False)]
)
def test_the_robot_witnesses_what_it_could_have_tested(start: str, told: bool) -> None:
    rules = Rules(goal=GOAL, observability={"fine_exo_move": Observability("colocated")})
    core = begin(["fine_loc(rob1,room1_1)", f"fine_loc(object1_1,{start})"], rules=rules)
    goes_to = "room2_1"
    core.advance(
        Literal.parse("test_fine_in_hand(rob1,object1_1)"),
        Literal.parse(f"fine_exo_move(object1_1,{goes_to})"),
    )
    assert bool(core.percept.events) == told


def test_games_follow_from_their_seed_and_go_on_from_a_snapshot() -> None:
    def play(core: Core, seed: int, steps: int) -> list[object]:
        choose, seen = np.random.default_rng(seed), []
        for _ in range(steps):
            action = core.robot_actions[int(choose.integers(len(core.robot_actions)))]
            action = WAIT if action == FINISH else action
            legal = core.events(action)
            core.advance(action, legal[int(choose.integers(len(legal)))])
            seen.append((core.situation, core.percept))
        return seen

    statistics = {"fine_move": 0.6, "test_fine_loc": 0.6}
    one, other = (
        fine_core(refinement((2, 2), rooms=3), Rules(goal=(), steps=10**6), statistics)
        for _ in range(2)
    )
    episodes = []
    for seed in range(10):
        one.reset(seed)
        other.reset(seed)
        episodes.append(play(one, seed, 40))
        assert episodes[-1] == play(other, seed, 40)
        moment = one.snapshot()
        ahead = play(one, 7, 20)
        other.restore(moment)
        assert play(other, 7, 20) == ahead
    assert len({str(episode) for episode in episodes}) == 10


def test_random_starts_are_initial_states_that_hold_something_now_and_then() -> None:
    fine = refinement((2, 2), (1, 1), rooms=3)
    world = world_of(fine)
    start, random = RandomStart(world, "rob1", holding=0.2), np.random.default_rng(1)
    cells: dict[str, set[str]] = {}
    held = Counter[str]()
    for _ in range(600):
        state = start(random)
        true = world.true_atoms(state)
        assert world.state([a for a in true if a in world.description.inertial]) == state
        for atom in true:
            name, _, arguments = atom.partition("(")
            if name == "fine_loc":
                thing, cell = arguments[:-1].split(",")
                cells.setdefault(thing, set()).add(cell)
        held.update(atom for atom in true if atom.startswith("fine_in_hand"))
    assert all(len(found) == 6 for found in cells.values())
    # 600 draws at 0.2 have a standard deviation of 10.
    assert held.total() == pytest.approx(120, abs=45)
    assert len(held) == 5
    assert not any(world.holds(RandomStart(world, "rob1", 0.0)(random), h) for h in held)


def test_what_is_not_magnified_is_seen_as_ever() -> None:
    file, text = read_domain("office")
    fine = load(text, file, OFFICE_CELLS, "cells.fine")
    core = fine_core(fine, Rules(goal=("loc(book1,library)",)))
    books = ["fine_loc(book1,library_1)", "fine_loc(book2,kitchen_1)"]
    core.reset(0, ["fine_loc(rob1,kitchen_1)", *books, "locked(library)"])
    assert "locked(library)" in core.percept.visible
    assert not any("loc(" in literal for literal in core.percept.visible)
    core.reset(0, ["fine_loc(rob1,office1_1)", *books])
    assert not any("locked" in literal for literal in core.percept.visible)
    core.reset(0, ["fine_loc(rob1,kitchen_2)", *books, "locked(library)"])
    assert not core.execution.possible(
        core.situation.state, Literal.parse("fine_move(rob1,library_1)")
    )
    core.advance(Literal.parse("unlock(rob1,library)"))
    assert "-locked(library)" in core.percept.visible
    assert core.execution.possible(core.situation.state, Literal.parse("fine_move(rob1,library_1)"))
