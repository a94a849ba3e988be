"""The first action that came out otherwise than expected, by every course of states there is."""

from random import Random

from hypothesis import assume, event, given, settings
from hypothesis import strategies as st

from agents.shared.expectations import Expectations
from asp import parse_description
from asp.language import Description
from asp.reasoning import knowledge
from asp.reasoning.diagnosis import Explanation, History
from testbed.world import world_of
from tests.asp.reasoning.branching import DIE, DOOR, descriptions

STEPS = 4


@settings(max_examples=150)
@given(
    description=descriptions() | st.sampled_from([parse_description(DIE), parse_description(DOOR)]),
    seed=st.integers(0, 999),
)
def test_it_is_the_first_after_which_no_course_agrees(description: Description, seed: int) -> None:
    world, random = world_of(description), Random(seed)
    states = list(world.states())
    assume(states)
    known = knowledge("random", description.source)
    fluents, actions = list(description.fluents), list(description.agent_actions)
    wanted, state = (random.choice(fluents),), random.choice(states)
    seen = random.sample(fluents, random.randint(0, len(fluents)))
    expectations, history = Expectations(known, wanted), History()
    expectations.believe(1, frozenset(world.true_atoms(state)), ())
    courses = [[state]]
    for step in range(1, STEPS + 1):
        possible = [own for own in actions if world.executable(state, (own,))]
        assume(possible)
        action = random.choice(possible)
        done = (action,)
        history.attempt(action, step)
        history.happened(action, True, step)
        state = random.choice(world.successors(state, done))
        courses = [
            [*course, after]
            for course in courses
            if world.executable(course[-1], done)
            for after in world.successors(course[-1], done)
        ]
        observed = [each for each in world.literals(state) if each.atom in seen]
        history.step = step + 1
        history.observe(observed, step + 1)
        courses = [course for course in courses if world.satisfies(course[-1], observed)]
    is_contradicted = expectations.follow(history, Explanation())
    expected = dict(expectations.states)
    agreeing = [
        {place + 1: frozenset(world.true_atoms(each)) for place, each in enumerate(course)}
        for course in courses
    ]
    assert agreeing, "that of the world is one of them"
    assert is_contradicted == (expected not in agreeing)
    if is_contradicted:
        steps = range(2, STEPS + 2)
        wrong = next(
            step for step in steps if all(expected.get(step) != own[step] for own in agreeing)
        )
        found = expectations.other_outcome(history, Explanation())
        event(f"another outcome at step {wrong - 1}")
        assert found is not None
        assert found.step == wrong - 1
        assert expectations.states in agreeing
