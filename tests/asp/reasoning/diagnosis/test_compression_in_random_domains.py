"""Compressed histories of random domains that share no word with the office."""

from dataclasses import replace
from random import Random

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from asp.language import Literal, parse_description
from asp.reasoning import Goal, knowledge
from asp.reasoning.diagnosis import Explanation, ReferenceDiagnoser
from benchmarks.own_domains import Domain
from benchmarks.own_trials import random_domain
from testbed.world import world_of
from tests.agents.intentional.lives import Place
from tests.asp.reasoning.diagnosis.minds import TINY, Mind, compare
from tests.asp.reasoning.diagnosis.wandering import Habits, wander

STEPS, FEWER_STEPS, FEW_STEPS = 20, 16, 9
HARSH = Habits(0.25, 0.5, false_report=0.2, late=6, looks=0.5, fails=0.3, doubts=0.3)

domains = st.integers(0, 10**6).map(lambda seed: random_domain(Random(seed)))
habits = st.builds(
    Habits,
    event=st.sampled_from([0.1, 0.25]),
    reported=st.sampled_from([0.0, 0.5, 1.0]),
    false_report=st.sampled_from([0.0, 0.1]),
    late=st.sampled_from([0, 6]),
    looks=st.sampled_from([0.4, 1.0]),
    fails=st.sampled_from([0.0, 0.3]),
    doubts=st.sampled_from([0.0, 0.3]),
)


def _place(domain: Domain, dark: bool, usual: bool) -> Place:
    """The domain, perhaps with a default about where each thing is."""
    text = domain.text
    if usual:
        text += f"\ndefaults\n  usual: {domain.of_thing}(T, {domain.spots[-1]}) if thing(T).\n"
    return Place("fen", world_of(parse_description(text, "fen.al")), text, dark)


def _goal(domain: Domain) -> Goal:
    return (Literal.of(domain.of_thing, (domain.things[0], domain.spots[0])),)


@settings(max_examples=10)
@given(domains, habits, st.integers(0, 10**6), st.booleans(), st.booleans())
def test_what_is_compressed_gives_the_answers_of_the_whole_history(
    domain: Domain, habits: Habits, seed: int, dark: bool, usual: bool
) -> None:
    compare(_place(domain, dark, usual), _goal(domain), STEPS, seed, habits, TINY)


@pytest.mark.parametrize("kept", [1, 3])
@pytest.mark.parametrize(
    ("seed", "arcs", "most"),
    [
        (0, 2, 64),
        (2, 4, 64),
        (3, 2, 4),
        (7, 3, 64),
        (8, 4, 64),
        (14, 4, 64),
        (15, 2, 4),
        (21, 2, 4),
    ],
)
def test_little_room_gives_the_answers_of_the_whole_history(
    seed: int, arcs: int, most: int, kept: int
) -> None:
    """Together they need every part of the order, of late news and of what is left out."""
    where = random_domain(Random(seed))
    place = _place(where, dark=seed % 2 == 0, usual=seed % 3 == 0)
    compression = replace(TINY, arcs=arcs, most=most, kept=kept)
    compare(place, _goal(where), FEWER_STEPS, seed, HARSH, compression)


@settings(max_examples=6)
@given(domains, habits, st.integers(0, 10**6), st.booleans(), st.booleans())
def test_what_is_compressed_gives_the_answers_of_the_reference(
    domain: Domain, habits: Habits, seed: int, dark: bool, usual: bool
) -> None:
    where, goal = _place(domain, dark, usual), _goal(domain)
    mind = Mind(where, TINY, goal, since=0)
    reference = ReferenceDiagnoser(knowledge(where.domain, where.source), goal)
    theirs = Explanation()
    untold = replace(habits, told=0.0)  # the theory of goals is that of robots
    for history in wander(where, goal, FEW_STEPS, seed, untold):
        mind.think(history)
        theirs = reference.diagnose(history, theirs).explanation
        assert mind.adopted == theirs, history.step
