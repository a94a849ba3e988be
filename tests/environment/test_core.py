"""The turn of a step: what happens, who is told, and how a game ends."""

from collections.abc import Sequence
from dataclasses import replace

import pytest

from asp import Description, load_description, parse_description
from asp.language import Literal
from testbed.environment import (
    Core,
    Ending,
    Execution,
    IllegalActionError,
    Mode,
    Observability,
    Rules,
)
from testbed.protocol import FINISH, NONE, WAIT
from testbed.world import StateError, UnknownFluentError, world_of
from tests.literals import parsed

WORLD = world_of(load_description("office"))
IN_KITCHEN = ("loc(rob1,kitchen)", "in_hand(rob1,book1)", "loc(book2,kitchen)")
GOAL = ("loc(book1,library)", "-in_hand(rob1,book1)")
RULES = Rules(goal=GOAL)
TO_LIBRARY, PUT_DOWN = Literal.parse("move(rob1,library)"), Literal.parse("put_down(rob1,book1)")


def begin(rules: Rules = RULES, initial: Sequence[str] = IN_KITCHEN, seed: int = 0) -> Core:
    core = Core(WORLD, rules, WORLD.initial_states())
    core.reset(seed, initial)
    return core


def _news(core: Core) -> list[tuple[int, str]]:
    return [(event.step, event.action) for event in core.percept.events]


def test_a_game_begins_at_step_1_with_nothing_attempted() -> None:
    core = begin()
    percept = core.percept
    assert percept.step == 1
    assert (percept.attempted, percept.happened, percept.events) == (None, None, [])
    assert percept.goal_holds is None
    assert core.world.satisfies(core.situation.state, IN_KITCHEN)


def test_both_actions_take_effect_at_once() -> None:
    core = begin()
    core.advance(TO_LIBRARY, Literal.parse("exo_move(book2,office1)"))
    expected = ("loc(rob1,library)", "loc(book1,library)", "loc(book2,office1)")
    assert core.world.satisfies(core.situation.state, expected)
    percept = core.percept
    assert (percept.step, percept.attempted, percept.happened) == (2, TO_LIBRARY, True)
    assert "loc(rob1,library)" in percept.visible


def test_an_impossible_attempt_does_not_happen_but_the_event_beside_it_does() -> None:
    core = begin()
    core.advance(*parsed(["move(rob1,office1)", "exo_lock(library)"]))
    assert core.world.satisfies(core.situation.state, ("loc(rob1,kitchen)", "locked(library)"))
    assert (core.percept.attempted, core.percept.happened) == ("move(rob1,office1)", False)


@pytest.mark.parametrize("answer", [WAIT, FINISH])
def test_a_thinking_robot_attempts_nothing(answer: str) -> None:
    core = begin()
    before = core.situation.state
    core.advance(answer)
    assert core.situation.state == before
    assert (core.percept.attempted, core.percept.happened) == (None, None)


def test_what_the_adversary_may_do_beside_the_robot() -> None:
    core = begin()
    assert set(core.events(TO_LIBRARY)) == {
        NONE,
        "exo_lock(library)",
        "exo_move(book2,office1)",
        "exo_move(book2,office2)",
        "exo_move(book2,library)",
    }
    free = begin(initial=("loc(rob1,kitchen)", "loc(book1,kitchen)", "loc(book2,kitchen)"))
    # A book being picked up cannot be moved elsewhere at the same time.
    beside = free.events(Literal.parse("pickup(rob1,book1)"))
    assert not any(event.startswith("exo_move(book1") for event in beside)
    assert "exo_move(book2,office1)" in beside
    # Beside an attempt in vain everything is possible that is possible by itself.
    assert free.events(Literal.parse("put_down(rob1,book1)")) == free.events(None)


@pytest.mark.parametrize(
    ("thinking", "answer", "some"),
    [(False, WAIT, False), (True, WAIT, True), (False, FINISH, False), (True, FINISH, False)],
)
def test_events_while_the_robot_thinks(thinking: bool, answer: str, some: bool) -> None:
    core = begin(replace(RULES, exogenous_while_thinking=thinking))
    assert (len(core.events(answer)) > 1) is some


@pytest.mark.parametrize("event", WORLD.exogenous_actions)
@pytest.mark.parametrize("answer", [WAIT, FINISH, *WORLD.agent_actions])
def test_an_event_is_legal_exactly_where_no_reason_speaks_against_it(
    answer: str, event: str
) -> None:
    core = begin()
    if core.why_not(answer, event) is None:
        core.advance(answer, event)
        assert core.situation.step == 2
    else:
        with pytest.raises(IllegalActionError, match=r"step 1: exo_\w+\(.*\) beside "):
            core.advance(answer, event)


@pytest.mark.parametrize(
    ("answer", "event", "message"),
    [
        ("fly(rob1)", NONE, r"fly\(rob1\) is not an action of the robot"),
        (WAIT, "rain", "rain is not an action of the adversary"),
        (WAIT, "exo_lock(library)", "nothing exogenous happens while the robot waits"),
        (FINISH, "exo_lock(library)", "nothing exogenous happens while the robot finishes"),
        (TO_LIBRARY, "exo_move(book1,office1)", r"if in_hand\(rob1,book1\)"),
    ],
)
def test_an_illegal_step_changes_nothing(answer: str, event: str, message: str) -> None:
    core = begin()
    before = core.snapshot()
    with pytest.raises(IllegalActionError, match=message):
        core.advance(answer, event)
    assert core.snapshot() == before


def test_a_goal_that_holds_is_achieved_only_when_the_robot_says_so() -> None:
    core = begin()
    for action in (TO_LIBRARY, PUT_DOWN):
        core.advance(action)
        assert core.situation.ending is None
    assert core.achieved
    core.advance(FINISH)
    assert core.situation.ending is Ending.ACHIEVED


def test_a_wrong_finish_is_answered_once() -> None:
    core = begin()
    core.advance(FINISH)
    assert core.situation.ending is None
    assert core.percept.goal_holds is False
    core.advance(TO_LIBRARY)
    assert core.percept.goal_holds is None
    core.advance(FINISH)
    assert core.percept.goal_holds is False
    core.advance(FINISH)
    assert core.situation.ending is Ending.FALSE_FINISH


def test_without_feedback_a_wrong_finish_ends_the_game() -> None:
    core = begin(replace(RULES, goal_feedback=False))
    core.advance(FINISH)
    assert core.situation.ending is Ending.FALSE_FINISH
    assert core.percept.goal_holds is None


def test_the_last_step_is_the_limit() -> None:
    core = begin(replace(RULES, steps=3))
    core.advance(WAIT)
    core.advance(WAIT)
    assert core.situation.ending is None
    core.advance(WAIT)
    assert core.situation.ending is Ending.STEP_LIMIT
    with pytest.raises(IllegalActionError, match="the game is over"):
        core.advance(WAIT)


def test_a_finish_at_the_last_step_still_counts() -> None:
    core = begin(replace(RULES, steps=3))
    for action in (TO_LIBRARY, PUT_DOWN, FINISH):
        core.advance(action)
    assert core.situation.ending is Ending.ACHIEVED


@pytest.mark.parametrize(
    ("mode", "event", "told"),
    [
        ("never", "exo_move(book2,office1)", False),
        ("always", "exo_move(book2,office1)", True),
        # The robot is in the kitchen before the step, and in the library after it.
        ("colocated", "exo_move(book2,office1)", True),
        ("colocated", "exo_move(book2,library)", True),
        ("colocated", "exo_move(book3,office2)", False),
        ("colocated", "exo_move(book3,library)", True),
    ],
)
def test_who_is_told_of_an_event(mode: Mode, event: str, told: bool) -> None:
    world = world_of(_with_a_third_book())
    rules = replace(RULES, observability={"exo_move": Observability(mode)})
    core = Core(world, rules, ())
    core.reset(0, (*IN_KITCHEN, "loc(book3,office1)"))
    core.advance(TO_LIBRARY, Literal.parse(event))
    assert _news(core) == ([(1, event)] if told else [])


def test_a_lock_is_witnessed_from_the_rooms_beside_it_only() -> None:
    rules = replace(RULES, observability={"exo_lock": Observability("colocated")})
    near = begin(rules)
    near.advance(Literal.parse("pickup(rob1,book2)"), Literal.parse("exo_lock(library)"))
    assert _news(near) == [(1, "exo_lock(library)")]
    far = begin(rules, ("loc(rob1,office1)", "loc(book1,office2)", "loc(book2,kitchen)"))
    far.advance(Literal.parse("pickup(rob1,book2)"), Literal.parse("exo_lock(library)"))
    assert far.percept.events == []


def test_late_news_says_when_it_happened() -> None:
    rules = replace(RULES, observability={"exo_lock": Observability("always", delay=2)})
    core = begin(rules)
    core.advance(Literal.parse("pickup(rob1,book2)"), Literal.parse("exo_lock(library)"))
    heard = []
    for _ in range(4):
        heard.append(_news(core))
        core.advance(WAIT)
    assert heard == [[], [], [(1, "exo_lock(library)")], []]


def test_a_false_report_is_of_something_possible_that_did_not_happen() -> None:
    how = {"exo_move": Observability("always", false_reports=0.3)}
    core = begin(replace(RULES, observability=how))
    start, _ = core.snapshot()
    happened = Literal.parse("exo_move(book2,office1)")
    possible = {event for event in core.events(TO_LIBRARY) if event.startswith("exo_move")}
    reports = []
    for _ in range(500):
        core.restore((start, core.snapshot()[1]))
        core.advance(TO_LIBRARY, happened)
        (step, first), *others = _news(core)
        assert (step, first) == (1, happened)
        reports += others
    assert {event for _, event in reports} == possible - {happened}
    assert {step for step, _ in reports} == {1}
    assert 0.2 < len(reports) / 500 < 0.4  # the standard deviation is 0.02


def test_nothing_is_reported_of_steps_at_which_nothing_can_happen() -> None:
    core = begin(replace(RULES, observability={"exo_lock": Observability(false_reports=1.0)}))
    core.advance(WAIT)
    assert _news(core) == []
    core.advance(Literal.parse("pickup(rob1,book2)"))
    assert _news(core) == [(2, "exo_lock(library)")]


def test_an_event_is_told_with_its_probability() -> None:
    rules = replace(RULES, observability={"exo_lock": Observability("always", 0.3)})
    core = begin(rules)
    start, _ = core.snapshot()
    told = 0
    for _ in range(500):
        core.restore((start, core.snapshot()[1]))
        core.advance(TO_LIBRARY, Literal.parse("exo_lock(library)"))
        told += len(core.percept.events)
    assert 0.2 < told / 500 < 0.4  # the standard deviation is 0.02


def test_the_initial_state_is_drawn_with_the_seed_or_given() -> None:
    core = Core(WORLD, RULES, WORLD.initial_states())
    drawn = []
    for seed in (*range(50), *range(50)):
        core.reset(seed)
        drawn.append(core.situation.state)
    assert drawn[:50] == drawn[50:]
    assert set(drawn) <= set(WORLD.initial_states())
    assert len(set(drawn)) > 30
    with pytest.raises(StateError, match="not a fluent"):
        core.reset(0, ["loc(rob1,attic)"])


def test_a_snapshot_brings_back_the_future_as_well() -> None:
    rules = replace(RULES, observability={"exo_lock": Observability("always", 0.5)})
    core = begin(rules)
    start, unlock = core.snapshot(), Literal.parse("unlock(rob1,library)")
    other = Core(WORLD, rules, ())

    def play(player: Core) -> list[object]:
        player.restore(start)
        futures: list[object] = []
        for _ in range(10):
            player.advance(unlock, player.events(unlock)[-1])
            futures.append(player.percept)
        return futures

    first = play(core)
    assert play(core) == first
    assert play(other) == first


def test_an_unknown_goal_is_refused() -> None:
    with pytest.raises(UnknownFluentError, match=r"loc\(book9,library\)"):
        Core(WORLD, Rules(goal=("loc(book9,library)",)), ())


def _with_a_third_book() -> Description:
    source = load_description("office").source
    return parse_description(source.replace("{book1, book2}", "{book1, book2, book3}"))


# What the robot does makes room for what others do; by itself the event contradicts the constraint.
MAKES_ROOM = """
sorts
  robot = {r}.
fluents
  inertial f.  inertial g.
actions
  agent a(robot).  exogenous e.
laws
  a(R) causes g.
  e causes f.
  -f if -g.
"""


class Slippery(Execution):
    """An action may come to nothing."""

    def chance(self, _action: str, /) -> float:
        return 0.5


def test_an_event_is_legal_only_if_it_is_however_the_action_comes_out() -> None:
    world = world_of(parse_description(MAKES_ROOM))
    sure, slippery = (
        Core(world, Rules(goal=()), (0,), execution(world, "r"))
        for execution in (Execution, Slippery)
    )
    sure.reset(0)
    slippery.reset(0)
    assert sure.events(Literal.parse("a(r)")) == (NONE, "e")
    assert slippery.events(Literal.parse("a(r)")) == (NONE,)
    with pytest.raises(IllegalActionError, match="the effects of e contradict"):
        slippery.advance(Literal.parse("a(r)"), "e")
