"""Operators have the transitions of the compiled world, or the description has none."""

import random
from collections.abc import Iterator

import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st

from asp import SourceError
from asp.language import Description, parse_description
from asp.reasoning.planning import Encoding
from asp.reasoning.planning.large.outcomes import NotEncodableError
from benchmarks.offices import office
from benchmarks.search import Search
from testbed.world import world_of

OFFICES = (
    office(),
    office(books=1, rooms=3),
    office(books=3, rooms=5, shape="tree", secure=2),
    office(books=2, rooms=6, shape="grid"),
)

FLUENTS = ("p", "q", "r", "s")
ACTIONS = ("a", "b")

# One of two lamps goes out when the third is switched on, and nothing says which.
FUSE = """
fluents
  inertial p. inertial q. inertial r.
actions
  agent a.
laws
  a causes r.
  -p if q, r.
  -q if p, r.
"""


@pytest.mark.parametrize("source", OFFICES)
def test_operators_lead_where_actions_lead(source: str) -> None:
    description = parse_description(source, "office.al")
    world, search = world_of(description), Search(Encoding(description))
    rng = random.Random(1)
    state = next(s for s in world.initial_states())
    for _ in range(150):
        expected = {
            action: search.state(world.true_atoms(world.successor(state, [action])))
            for action in world.agent_actions
            if world.executable(state, [action])
        }
        found = list(search.successors(search.state(world.true_atoms(state))))
        assert len(found) == len(expected)
        assert dict(found) == expected
        anything = (*world.agent_actions, *world.exogenous_actions)
        state = world.successor(
            state, [rng.choice([a for a in anything if world.executable(state, [a])])]
        )


literals = st.sampled_from([sign + fluent for fluent in FLUENTS for sign in ("", "-")])
bodies = st.lists(literals, max_size=2, unique=True).map(", ".join)
effects = st.builds("{} causes {} if {}.".format, st.sampled_from(ACTIONS), literals, bodies)
constraints = st.builds("{} if {}.".format, literals, bodies.filter(bool))
hindrances = st.builds("impossible {} if {}.".format, st.sampled_from(ACTIONS), bodies.filter(bool))
exclusions = st.just("-p if q. -q if p.") | st.just("-q if r. -r if q. -p if q. -p if r.")


@st.composite
def sources(draw: st.DrawFn) -> str:
    laws = draw(st.lists(effects, min_size=1, max_size=4))
    laws += draw(st.lists(constraints | exclusions, max_size=3))
    laws += draw(st.lists(hindrances, max_size=2))
    declared = " ".join(f"inertial {fluent}." for fluent in FLUENTS)
    actions = " ".join(f"agent {action}." for action in ACTIONS)
    written = "\n  ".join(laws).replace(" if .", ".")
    return f"fluents\n  {declared}\nactions\n  {actions}\nlaws\n  {written}\n"


# What can never be true; by itself, and as one of two that exclude each other.
NEVER = "fluents\n inertial p. inertial q.\nactions\n agent a.\nlaws\n a causes p.\n -p if p.\n"


@settings(max_examples=400)
@example(NEVER)
@example(NEVER + " -p if q. -q if p.\n")
@given(sources())
def test_operators_are_exact_or_there_are_none(source: str) -> None:
    try:
        description = parse_description(source, "drawn.al")
    except SourceError:
        return
    try:
        search = Search(Encoding(description))
    except NotEncodableError:
        return
    for true, successors in _transitions(description):
        found = list(search.successors(search.state(true)))
        moved = {(a, search.state(after)) for a, after in successors}
        assert set(found) == moved
        assert len({action for action, _ in found}) == len(found)


def _transitions(
    description: Description,
) -> Iterator[tuple[tuple[str, ...], list[tuple[str, tuple[str, ...]]]]]:
    world = world_of(description)
    for state in world.initial_states():
        yield (
            world.true_atoms(state),
            [
                (action, world.true_atoms(after))
                for action in world.agent_actions
                for after in world.successors(state, [action])
            ],
        )


def test_several_outcomes_are_told_from_one() -> None:
    description = parse_description(FUSE, "fuse.al")
    with pytest.raises(NotEncodableError, match="several outcomes"):
        Encoding(description)


def test_what_is_no_state_has_no_values() -> None:
    encoding = Encoding(parse_description(office(), "office.al"))
    here = {"loc(rob1,kitchen)", "loc(book1,kitchen)", "loc(book2,kitchen)"}
    assert encoding.values(here) is not None
    assert encoding.values(here - {"loc(book2,kitchen)"}) is None
    assert encoding.values(here | {"loc(book2,library)"}) is None
    assert encoding.values(here | {"in_hand(rob1,book1)"}) is not None
    assert encoding.values((here - {"loc(book1,kitchen)"}) | {"loc(book1,library)"}) is not None
    away = {"loc(rob1,kitchen)", "loc(book1,library)", "loc(book2,kitchen)"}
    assert encoding.values(away | {"in_hand(rob1,book1)"}) is None
