"""A robot that looks at what it only assumes needs nobody to tell it whether its goal holds."""

import random
from collections.abc import Callable, Sequence

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from agents.intentional import IntentionalRobot
from agents.intentional.checking import CheckingRobot, to_be_sure
from agents.shared import reasoning, sessions_of
from agents.shared.reasoning import Sessions
from asp.language import parse_description
from asp.reasoning import knowledge
from asp.solving import Recent
from testbed.protocol import Robot, Task
from tests.agents.intentional.lives import (
    BOTH_IN_THE_LIBRARY,
    DOMAIN,
    OFFICE,
    SOURCE,
    WORLD,
    Life,
    Wish,
    live,
)
from tests.agents.intentional.test_incremental import BOTH
from tests.literals import parsed
from tests.oracle import minimal_actions

STATES = list(WORLD.initial_states())
EMPTY_HAND = parsed(["-in_hand(rob1,book1)", "-in_hand(rob1,book2)"])
APART = ("loc(book1,kitchen)", "loc(book2,office1)", *EMPTY_HAND)


def _both_in(room: str) -> tuple[str, ...]:
    return (f"loc(book1,{room})", f"loc(book2,{room})", *EMPTY_HAND)


def _lives(make: Callable[[], Robot], goal: Sequence[str], step: int) -> list[Life]:
    """One event at this step, the same for every robot, and nobody says whether the goal holds."""
    dice = random.Random(step)
    return [
        live(make(), state, goal, {step: Wish(dice.randrange(9))}, steps=90, feedback=False)
        for state in STATES
    ]


def _false(lives: Sequence[Life]) -> int:
    return sum(life.finished and not life.achieved for life in lives)


@pytest.mark.parametrize(
    ("room", "step"), [("kitchen", 2), ("kitchen", 8), ("office1", 5), ("library", 4)]
)
def test_where_it_sees_all_of_its_goal_at_once_it_never_finishes_falsely(
    room: str, step: int, capsys: pytest.CaptureFixture[str]
) -> None:
    """The last look at the one book is a look at the other, so that no event comes after it."""
    checking = _lives(CheckingRobot, _both_in(room), step)
    plain = _lives(IntentionalRobot, _both_in(room), step)
    with capsys.disabled():
        print(
            f"\n{room}, an event at step {step}: of {len(STATES)} trials without goal feedback "
            f"intentional finishes {_false(plain)} falsely, intentional-checking {_false(checking)}"
        )
    assert [life for life in checking if not life.finished] == []
    assert _false(checking) == 0
    # The library is declared last, so that other rooms are assumed before it.
    assert _false(plain) > 0 or room == "library"


def test_what_is_false_when_it_finishes_became_so_after_its_last_look() -> None:
    """Nobody can see both rooms at once; no robot can do better, but by looking for ever."""
    lives = [life for step in (3, 9) for life in _lives(CheckingRobot, APART, step)]
    assert all(life.finished for life in lives)
    wrong = [
        (life, literal)
        for life in lives
        for literal in APART
        if not WORLD.holds(life.states[-1], literal)
    ]
    assert wrong
    assert [pair for pair in wrong if not _true_at_last_look(*pair)] == []


def _true_at_last_look(life: Life, literal: str) -> bool:
    seen = {literal, f"-{literal}"}
    looks = [s for s in life.states if not seen.isdisjoint(WORLD.visible(s, OFFICE.robot))]
    last = looks[-1] if looks else life.states[0]
    return WORLD.holds(last, literal)


def test_undisturbed_it_does_no_more_than_it_has_to() -> None:
    for state in STATES[::3]:
        life = live(CheckingRobot(), state, BOTH_IN_THE_LIBRARY, feedback=False)
        physical = [d.action for d in life.decisions if d.action not in ("wait", "finish")]
        assert life.achieved
        assert len(physical) == minimal_actions(WORLD, state, BOTH_IN_THE_LIBRARY)


def test_it_goes_and_looks_where_it_assumes_its_goal_to_hold() -> None:
    """Book2 vanishes from the kitchen, to the library. To office1 is as good an explanation."""
    initial = WORLD.state(parsed(["loc(rob1,kitchen)", "loc(book1,kitchen)", "loc(book2,kitchen)"]))
    possible = [e for e in WORLD.exogenous_actions if WORLD.executable(initial, [e])]
    wishes = {1: Wish(possible.index("exo_move(book2,library)"))}
    goal = ("loc(book2,office1)", *EMPTY_HAND)
    plain = live(IntentionalRobot(), initial, goal, wishes, feedback=False)
    assert (plain.finished, plain.achieved) == (True, False)
    life = live(CheckingRobot(), initial, goal, wishes, feedback=False)
    assert (life.finished, life.achieved) == (True, True)
    plans = [d.trace.plan for d in life.decisions if d.trace.intention.startswith("start(")]
    assert plans[1] == ["move(rob1,office2)", "move(rob1,office1)"]
    assert all(set(d.trace.belief) <= set(WORLD.fluents) for d in life.decisions)


@settings(max_examples=8)
@given(
    initial=st.sampled_from(STATES),
    goal=st.sampled_from([_both_in("kitchen"), APART, parsed(["-loc(book2,office2)"])]),
    wishes=st.dictionaries(
        st.integers(1, 12), st.builds(Wish, st.integers(0, 8), st.booleans()), max_size=2
    ),
)
def test_on_kept_controls_it_decides_as_from_scratch(
    initial: int, goal: tuple[str, ...], wishes: dict[int, Wish]
) -> None:
    live(CheckingRobot(BOTH), initial, goal, wishes, steps=16, feedback=False)


def _task(source: str, goal: Sequence[str]) -> Task:
    return Task(
        trial="t",
        robot="intentional-checking",
        domain=DOMAIN,
        source=source,
        goal=list(goal),
        initial=parsed(["loc(book1,kitchen)", "-loc(book1,library)"]),
        plan_limit=9,
        seed=0,
    )


def test_its_task_is_the_task_with_what_it_has_to_be_sure_of() -> None:
    task = to_be_sure(_task(SOURCE, parsed(["loc(book1,kitchen)", "loc(book1,library)"])))
    assert task.goal == ["loc(book1,kitchen)", "loc(book1,library)", "sure_1", "sure_2"]
    assert task.initial == ["loc(book1,kitchen)", "-loc(book1,library)", "sure_1", "-sure_2"]
    description = parse_description(task.source, "office.al")
    laws = {(law.head, frozenset(law.body)) for law in description.constraints}
    assert ("sure_1", frozenset(parsed({"loc(book1,kitchen)", "loc(rob1,kitchen)"}))) in laws
    assert ("-sure_1", frozenset(parsed({"-loc(book1,kitchen)"}))) in laws


def test_of_many_goals_only_the_last_domains_keep_their_controls(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.setattr(reasoning, "_SESSIONS", Recent(2))
    initial = WORLD.state(parsed(["loc(rob1,kitchen)", "loc(book1,kitchen)", "loc(book2,kitchen)"]))
    kept = list[Sessions]()
    for room in ("office2", "library", "office2", "kitchen", "office2", "library"):
        goal = parsed([f"loc(rob1,{room})"])
        assert live(CheckingRobot(), initial, goal, feedback=False).achieved
        task = to_be_sure(_task(SOURCE, goal))
        kept.append(sessions_of(knowledge(DOMAIN, task.source)))
        assert len(reasoning._SESSIONS) <= 2
    first, other, again, _, still, anew = kept
    assert first is again is still, "used in between"
    assert other is not anew


def test_what_nothing_shows_is_not_asked_for() -> None:
    blind = SOURCE.replace("  R sees in_hand(R, O).\n", "")
    assert blind != SOURCE
    task = _task(blind, parsed(["-in_hand(rob1,book2)"]))
    assert to_be_sure(task) == task
