"""The adversary that does something at random now and then."""

from collections import Counter
from collections.abc import Sequence
from dataclasses import replace
from itertools import groupby
from typing import Any

import numpy as np
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


def at_rate(rate: float, events: Sequence[str] = EVENTS, **options: Any) -> Random:
    game = Game(scenario="", goal=(), exogenous_actions=events, description=NOWHERE)
    return Random(game, Random.Options(rate, **options))


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


@pytest.mark.parametrize("rate", [0.05, 0.3, 1.0])
@pytest.mark.parametrize("burst", [1.0, 4.0])
def test_a_burst_is_as_long_on_average_as_it_is_to_be_at_the_same_rate(
    burst: float, rate: float
) -> None:
    adversary = at_rate(rate, burst=burst)
    steps = [adversary.act(view([NONE, *EVENTS])) != NONE for _ in range(30_000)]
    assert np.mean(steps) == pytest.approx(rate, abs=0.02)
    if rate == 1:
        return
    # A burst that is over may be followed by another one at once: with the probability that one
    # begins, which lengthens what is seen as one.
    begins = rate / (rate + burst * (1 - rate))
    lengths = [len(list(own)) for acts, own in groupby(steps) if acts]
    assert np.mean(lengths) == pytest.approx(burst / (1 - begins), rel=0.1)


@pytest.mark.parametrize("delay", [0, 3])
@pytest.mark.parametrize("rate", [0.05, 0.3])
def test_the_rate_is_that_of_each_step_from_the_first_on(rate: float, delay: int) -> None:
    adversary, trials = at_rate(rate, burst=4.0, delay=delay), 2500
    acts = np.zeros(9)
    for seed in range(trials):
        adversary.reset(seed)
        for step in range(1, len(acts)):
            seen = replace(view([NONE, *EVENTS[:1]]), step=step)
            acts[step] += adversary.act(seen) != NONE
    first = max(1, delay)
    assert not acts[:first].any()
    # Four standard deviations of a share: a false alarm once in some thousand seeds.
    wanted = pytest.approx(rate, abs=4 * (rate * (1 - rate) / trials) ** 0.5)
    assert [*(acts[first:] / trials)] == [wanted] * (len(acts) - first)


def test_by_default_what_is_drawn_is_what_was_always_drawn() -> None:
    """As the strategy was before it had more options: a coin, then a thing, then an event."""
    for seed in range(5):
        one, random = at_rate(0.4), np.random.default_rng(seed)
        one.reset(seed)
        things = {event.arguments[0]: [] for event in EVENTS}
        for event in EVENTS:
            things[event.arguments[0]].append(event)
        groups, legal = list(things.values()), [NONE, *EVENTS[::3]]
        for _ in range(60):
            expected = NONE
            if random.random() < 0.4:
                drawn = (
                    groups[thing][place]
                    for thing in random.permutation(len(groups))
                    for place in random.permutation(len(groups[thing]))
                )
                expected = next(event for event in drawn if event in legal)
            assert one.act(view(legal)) == expected


def test_nothing_happens_before_the_delay_is_over() -> None:
    adversary = at_rate(1.0, delay=5)
    acts = [adversary.act(replace(view([NONE, *EVENTS]), step=step)) for step in range(1, 9)]
    assert [event != NONE for event in acts] == [False] * 4 + [True] * 4


def test_a_mix_says_how_often_events_of_each_name_happen() -> None:
    events = parsed(["take(a,w)", "take(b,x)", "drop(a)", "turn(b)"])
    adversary = at_rate(1.0, events, mix={"take": 3, "drop": 1, "turn": 0})
    drawn = Counter(adversary.act(view([NONE, *events])) for _ in range(4000))
    assert drawn.keys() == set(parsed(["take(a,w)", "take(b,x)", "drop(a)"]))
    # At 1/4 of 4000 draws the standard deviation is 27.
    assert drawn[events[2]] == pytest.approx(1000, abs=140)
    # What is not possible leaves its place to the others.
    assert {adversary.act(view([NONE, events[2]])) for _ in range(20)} == {events[2]}


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
