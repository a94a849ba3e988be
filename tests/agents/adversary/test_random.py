"""The adversary that does something at random now and then."""

from collections import Counter
from collections.abc import Sequence

import pytest

from agents.adversary import AdversaryView, Game, Random
from asp import parse_description
from asp.domains import level_text
from asp.refinement import load
from testbed.environment import Rules, fine_core
from testbed.protocol import FINISH, NONE
from tests.greenhouse import GREENHOUSE
from tests.literals import parsed

EVENTS = parsed([f"take({thing},{place})" for thing in "abc" for place in "wxyz"])


NOWHERE = parse_description(GREENHOUSE, "pots.al")


def at_rate(rate: float, events: Sequence[str] = EVENTS) -> Random:
    game = Game(scenario="", goal=(), exogenous_actions=events, description=NOWHERE)
    return Random(game, Random.Options(rate))


def view(legal: Sequence[str]) -> AdversaryView:
    return AdversaryView(step=1, state=frozenset(), robot_action="wait", legal=legal)


def test_it_acts_as_often_as_its_rate_says() -> None:
    adversary = at_rate(0.05)
    acts = sum(adversary.act(view([NONE, *EVENTS])) != NONE for _ in range(4000))
    # 4000 draws at 0.05 have a standard deviation of 14.
    assert acts == pytest.approx(200, abs=70)
    assert all(at_rate(0.0).act(view(EVENTS)) == NONE for _ in range(50))


def test_it_draws_a_thing_first_and_then_what_is_done_to_it() -> None:
    adversary = at_rate(1.0)
    legal = [NONE, "take(a,w)", "take(c,w)", "take(c,x)", "take(c,y)"]
    drawn = Counter(adversary.act(view(legal)) for _ in range(3000))
    # a and c alike, whatever can be done to them; of each as many draws at 1/2, 1/6.
    assert drawn.keys() == set(legal) - {NONE}
    assert drawn["take(a,w)"] == pytest.approx(1500, abs=140)
    for event in parsed(["take(c,w)", "take(c,x)", "take(c,y)"]):
        assert drawn[event] == pytest.approx(500, abs=110)


def test_where_nothing_is_possible_nothing_happens() -> None:
    assert at_rate(1.0).act(view([NONE])) == NONE


def test_everything_follows_from_the_seed() -> None:
    one, other = at_rate(0.5), at_rate(0.5)
    runs = []
    for seed in range(5):
        one.reset(seed)
        other.reset(seed)
        runs.append([one.act(view(EVENTS)) for _ in range(50)])
        assert runs[-1] == [other.act(view(EVENTS)) for _ in range(50)]
    assert len(set(map(tuple, runs))) == 5


def test_a_rate_that_is_no_probability_is_refused() -> None:
    with pytest.raises(ValueError, match=r"rate: 1\.2 does not lie between 0 and 1"):
        at_rate(1.2)


def test_what_it_does_in_a_game_is_legal_and_tried_only_until_something_is() -> None:
    coarse, fine = level_text(3, 2, 2, ((4, 2),))
    core = fine_core(load(coarse, "level.al", fine, "level.fine"), Rules(goal=(), steps=10**6))
    core.reset(3)
    adversary = at_rate(1.0, core.world.exogenous_actions)
    asked: list[str] = []
    for number in range(60):
        action = core.robot_actions[2 + number % (len(core.robot_actions) - 2)]
        legal = core.legal_events(action)
        asked.clear()
        seen = AdversaryView(core.situation.step, frozenset(), action, Watched(legal, asked))
        event = adversary.act(seen)
        assert event != NONE
        assert len(asked) < len(core.adversary_actions) / 2
        core.advance(action, event)
    assert core.events(FINISH) == (NONE,)


class Watched(Sequence[str]):
    """Notes what is asked of the events, and is never listed."""

    def __init__(self, events: Sequence[str], asked: list[str]) -> None:
        self._events, self._asked = events, asked

    def __contains__(self, event: object) -> bool:
        self._asked.append(str(event))
        return event in self._events

    def __getitem__(self, index: object) -> str:
        raise AssertionError("all events are listed")

    def __len__(self) -> int:
        raise AssertionError("all events are listed")
