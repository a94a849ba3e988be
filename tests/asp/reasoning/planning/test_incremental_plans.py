"""Plans looked for in a part of the domain are the first shortest plans of the whole domain."""

import random
from collections.abc import Sequence
from contextlib import suppress

import pytest
from clingo import Control

from asp.language import Action, Description, Literal, analyse, parse_description, read_domain
from asp.reasoning import Relevance
from asp.reasoning.planning import Encoding, IncrementalPlanner, incremental
from asp.reasoning.planning.large.outcomes import NotEncodableError
from asp.reasoning.planning.large.search import StateSpace
from asp.solving import LimitError, Limits, deciding
from benchmarks.offices import office
from testbed.world import World, world_of
from tests.literals import parsed

OFFICE = read_domain("office")[1]
FOUR_BOOKS = OFFICE.replace("{book1, book2}", "{book1, book2, book3, book4}")
# A shelf that can fall on the robot: what is true of a book changes something else.
ALARM = OFFICE.replace(
    "inertial locked(secure_room).", "inertial locked(secure_room).\n  inertial alarm."
).replace("  % State constraints.", "  alarm if in_hand(R, O), loc(O, library).\n")


def _first_shortest(
    world: World, state: int, goal: tuple[Literal, ...], limit: int
) -> tuple[Action, ...] | None:
    """The first plan in the order of declaration, by layers of a breadth-first search."""
    layer: dict[int, tuple[Action, ...]] = {state: ()}
    seen = {state}
    for _ in range(limit):
        following: dict[int, tuple[Action, ...]] = {}
        for now, plan in sorted(layer.items(), key=lambda item: _rank(world, item[1])):
            for action in world.agent_actions:
                for after in world.successors(now, (action,)):
                    if after not in seen and after not in following:
                        following[after] = (*plan, action)
        reached = [plan for after, plan in following.items() if world.satisfies(after, goal)]
        if reached:
            return min(reached, key=lambda plan: _rank(world, plan))
        seen |= following.keys()
        layer = following
    return None


def _rank(world: World, plan: tuple[Action, ...]) -> list[int]:
    return [world.agent_actions.index(action) for action in plan]


def _relevance(text: str) -> Relevance:
    return Relevance(*analyse(text, "office.al"))


def _planner(text: str) -> IncrementalPlanner:
    return IncrementalPlanner(text, "office.al")


def _some_goal(description: Description, draw: random.Random) -> tuple[Literal, ...]:
    fluents = [fluent for fluent in description.fluents if fluent.name != "locked"]
    chosen = draw.sample(fluents, draw.choice([1, 1, 2]))
    return tuple(draw.choice([fluent, fluent.complement]) for fluent in chosen)


@pytest.mark.parametrize("text", [OFFICE, FOUR_BOOKS, ALARM], ids=["office", "books", "alarm"])
def test_the_plan_is_the_first_shortest_of_the_whole_domain(text: str) -> None:
    draw = random.Random(7)
    description = parse_description(text, "office.al")
    world, plans = world_of(description), _planner(text)
    states = list(world.initial_states())
    for _ in range(60):
        state, goal = draw.choice(states), _some_goal(description, draw)
        if not world.satisfies(state, goal):
            found = plans.shortest(frozenset(world.true_atoms(state)), goal, 9)
            assert found == _first_shortest(world, state, goal, 9), (world.true_atoms(state), goal)


# Where a robot is while the library is open: a defined fluent.
LAMP = OFFICE.replace(
    "inertial locked(secure_room).", "inertial locked(secure_room).\n  defined free(robot, room)."
).replace("  % State constraints.", "  free(R, L) if loc(R, L), -locked(library).\n")

LAMPS = """\
sorts
  lamp = {a, b, c}.
fluents
  inertial on(lamp).
actions
  agent switch_on(lamp).
  agent switch_off(lamp).
laws
  switch_on(L)  causes on(L).
  switch_off(L) causes -on(L).
  impossible switch_on(L) if on(L).
  impossible switch_off(L) if -on(L).
"""

# The ways in which a plan may be looked for.
WAYS: dict[str, dict[str, int]] = {
    "searched": {},
    "with too many states": {"MOST_STATES": 30},
    "without a search": {"STATE_SET_SEARCH": False},
}


@pytest.mark.parametrize("way", WAYS)
@pytest.mark.parametrize(
    ("books", "rooms", "shape"), [(2, 4, "row"), (1, 6, "grid"), (3, 4, "tree")]
)
def test_every_way_to_the_plan_gives_the_first_shortest(
    books: int, rooms: int, shape: str, way: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    for name, value in WAYS[way].items():
        monkeypatch.setattr(f"asp.reasoning.planning.incremental.{name}", value)
    text = office(books, rooms, shape)
    description = parse_description(text, "office.al")
    world, plans, draw = world_of(description), _planner(text), random.Random(11)
    states = list(world.initial_states())
    for _ in range(15):
        state, goal = draw.choice(states), _some_goal(description, draw)
        if world.satisfies(state, goal):
            continue
        now = frozenset(world.true_atoms(state))
        found = plans.shortest(now, goal, 9)
        assert found == _first_shortest(world, state, goal, 9), (now, goal)
        if found is not None:
            assert plans.succeeds(now, goal, found)
            assert plans.succeeds(now, goal, (*found, found[0]))
            assert not plans.succeeds(now, goal, found[:-1])


@pytest.mark.parametrize("way", WAYS)
@pytest.mark.parametrize("lit", [True, False])
def test_a_plan_may_do_nothing_but_make_things_true_or_false(
    way: str, lit: bool, monkeypatch: pytest.MonkeyPatch
) -> None:
    for name, value in WAYS[way].items():
        monkeypatch.setattr(f"asp.reasoning.planning.incremental.{name}", value)
    lamps = parsed(["on(a)", "on(b)", "on(c)"])
    start, goal = ((), lamps) if lit else (lamps, tuple(lamp.complement for lamp in lamps))
    plan = tuple(f"switch_{'on' if lit else 'off'}({lamp})" for lamp in "abc")
    assert IncrementalPlanner(LAMPS, "lamps.al").shortest(frozenset(start), goal, 4) == plan


@pytest.mark.parametrize("search", [True, False])
def test_a_plan_succeeds_where_the_world_says_so(
    search: bool, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("asp.reasoning.planning.incremental.STATE_SET_SEARCH", search)
    description = parse_description(OFFICE, "office.al")
    world, plans, draw = world_of(description), _planner(OFFICE), random.Random(5)
    states, outcomes = list(world.initial_states()), set()
    for _ in range(150):
        state, goal = draw.choice(states), _some_goal(description, draw)[:1]
        plan, wanted, now = [], False, state
        for _ in range(draw.randint(1, 4)):
            plan.append(draw.choice(world.agent_actions))
            if draw.random() < 0.9:
                plan[-1] = draw.choice([a for a in world.agent_actions if _can(world, now, a)])
            if not _can(world, now, plan[-1]):
                break
            now = world.successor(now, (plan[-1],))
            wanted = wanted or world.satisfies(now, goal)
        true = frozenset(world.true_atoms(state))
        assert plans.succeeds(true, goal, tuple(plan)) is wanted, (true, goal, plan)
        outcomes.add(wanted)
    assert outcomes == {True, False}


def _can(world: World, state: int, action: Action) -> bool:
    return world.executable(state, (action,))


def test_a_plan_succeeds_from_where_only_others_can_bring_a_thing() -> None:
    """Somebody took the book away: it is in no room, and no action of the robot leads there."""
    text = OFFICE.replace(
        "exogenous exo_lock", "exogenous steal(book, room).\n  exogenous exo_lock"
    )
    text = text.replace("laws\n", "laws\n  steal(B, L) causes -loc(B, L).\n", 1)
    plans, there = IncrementalPlanner(text, "office.al"), parsed(["loc(rob1,kitchen)"])
    state = frozenset(parsed(["loc(rob1,office2)", "loc(book2,office2)"]))
    goal = (*there, *parsed(["-loc(book1,office1)"]))
    plan = plans.shortest(state, goal, 4)
    assert plan == tuple(parsed(["move(rob1,kitchen)"]))
    assert plans.succeeds(state, goal, plan)


def test_what_cannot_be_searched_is_planned_from_one_action_on() -> None:
    description = parse_description(LAMP, "office.al")
    with pytest.raises(NotEncodableError, match="defined"):
        Encoding(description)
    world, plans, draw = world_of(description), _planner(LAMP), random.Random(2)
    states = list(world.initial_states())
    for _ in range(25):
        state, goal = draw.choice(states), _some_goal(description, draw)
        if not world.satisfies(state, goal):
            found = plans.shortest(frozenset(world.true_atoms(state)), goal, 7)
            assert found == _first_shortest(world, state, goal, 7), (world.true_atoms(state), goal)


def test_a_plan_succeeds_too_where_the_goal_is_defined() -> None:
    plans = IncrementalPlanner(LAMP, "office.al")
    state = frozenset(parsed(["loc(rob1,office2)", "loc(book1,office2)", "loc(book2,office2)"]))
    there, back = parsed(["move(rob1,kitchen)", "move(rob1,office2)"])
    now = state | {Literal.parse("free(rob1,office2)")}
    assert plans.succeeds(now, parsed(["free(rob1,kitchen)"]), (there,))
    assert plans.succeeds(now, parsed(["-free(rob1,office2)"]), (there, back))
    assert not plans.succeeds(now, parsed(["free(rob1,library)"]), (there, back))
    assert not plans.succeeds(now, parsed(["-free(rob1,library)", "free(rob1,library)"]), (there,))
    assert not plans.succeeds(now, parsed(["-free(rob1,kitchen)"]), (there,))


def test_after_a_time_limit_planning_goes_on_where_it_was(monkeypatch: pytest.MonkeyPatch) -> None:
    asked = []
    search = StateSpace.search
    monkeypatch.setattr(StateSpace, "search", lambda *given: asked.append(given) or search(*given))
    plans = IncrementalPlanner(OFFICE, "office.al")
    state = frozenset(parsed(["loc(rob1,library)", "loc(book1,office1)", "loc(book2,office1)"]))
    goal = parsed(["loc(book1,library)", "loc(book2,library)"])
    with pytest.raises(LimitError), deciding(Limits(0)):
        plans.shortest(state, goal, 20)
    plan = plans.shortest(state, goal, 20)
    assert plan is not None
    assert len(asked) == 1
    assert plans.shortest(state, goal, 20) == plan
    assert len(asked) == 2  # no answer is remembered


def test_a_time_limit_at_each_length_loses_no_plan(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("asp.reasoning.planning.incremental.STATE_SET_SEARCH", False)
    state = frozenset(parsed(["loc(rob1,library)", "loc(book1,office1)", "loc(book2,office1)"]))
    goal = parsed(["loc(book1,library)"])
    whole = _planner(OFFICE).shortest(state, goal, 20)
    solving, interrupted = incremental.solving, set[object]()

    def at_second_attempt(control: Control, start: Sequence[int]) -> object:
        if control not in interrupted:
            interrupted.add(control)
            raise LimitError
        return solving(control, start)

    monkeypatch.setattr(incremental, "solving", at_second_attempt)
    plans, found = _planner(OFFICE), None
    for _ in range(20):
        with suppress(LimitError):
            found = plans.shortest(state, goal, 20)
            break
    assert len(interrupted) > 1
    assert found == whole


def test_a_goal_is_out_of_reach_where_all_states_were_looked_at() -> None:
    plans = IncrementalPlanner(OFFICE, "office.al")
    state = frozenset(parsed(["loc(rob1,library)", "loc(book1,office1)", "loc(book2,office1)"]))
    assert plans.reachable(state, parsed(["in_hand(rob1,book1)", "in_hand(rob1,book2)"])) is False
    assert plans.reachable(state, parsed(["loc(book1,library)", "loc(book2,library)"])) is True
    assert (
        IncrementalPlanner(LAMP, "office.al").reachable(state, parsed(["locked(library)"])) is None
    )


def test_books_can_be_left_out_but_not_rooms_or_the_robot() -> None:
    assert _relevance(OFFICE).independent == {"book1", "book2"}


def test_a_book_that_changes_something_else_cannot_be_left_out() -> None:
    assert _relevance(ALARM).independent == set()


def test_a_book_in_the_hand_stands_in_the_way() -> None:
    relevance = _relevance(OFFICE)
    state = parsed({"loc(rob1,kitchen)", "loc(book1,kitchen)", "loc(book2,office1)"})
    assert relevance.spare(state, parsed(["loc(book1,library)"])) == {"book2"}
    held = [*state, *parsed(["in_hand(rob1,book2)"])]
    assert relevance.spare(held, parsed(["loc(book1,library)"])) == set()
