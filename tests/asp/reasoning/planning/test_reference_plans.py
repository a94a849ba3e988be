"""Plans from scratch and incremental plans are the same."""

import random

import pytest

from asp.language import read_domain
from asp.reasoning import knowledge
from asp.reasoning.planning import IncrementalPlanner, ReferencePlanner
from testbed.world import world_of
from tests.greenhouse import GREENHOUSE

SHED = GREENHOUSE.replace(
    "inertial stands(pot, spot).", "inertial stands(pot, spot).\n  defined alone(spot)."
).replace(
    "  impossible blow", "  alone(S) if stands(P, S), -stands(Q, S), P != Q.\n  impossible blow"
)

CRANE = """\
sorts
  crane = {tall, low}.
  crate = {red, blue}.
  berth = {north, middle, south}.
statics
  beside(berth, berth).
fluents
  inertial lies(crate, berth).
  inertial hoisted(crane, crate).
  inertial above(crane, berth).
actions
  agent swing(crane, berth).
  agent hoist(crane, crate).
  agent lower(crane, crate).
laws
  beside(north, middle).
  beside(middle, north).
  beside(middle, south).
  beside(south, middle).
  swing(K, B) causes above(K, B).
  hoist(K, C) causes hoisted(K, C).
  lower(K, C) causes -hoisted(K, C).
  -above(K, B2) if above(K, B1), B1 != B2.
  -lies(C, B2) if lies(C, B1), B1 != B2.
  lies(C, B) if hoisted(K, C), above(K, B).
  -hoisted(K2, C) if hoisted(K1, C), K1 != K2.
  -hoisted(K, C2) if hoisted(K, C1), C1 != C2.
  impossible swing(K, B) if above(K, A), -beside(A, B).
  impossible hoist(K, C) if above(K, B), -lies(C, B).
  impossible hoist(K, C) if hoisted(J, C).
  impossible hoist(K, C) if hoisted(K, D).
  impossible lower(K, C) if -hoisted(K, C).
initially
  lies(C, B) for some B.
  above(K, B) for some B.
"""

DOMAINS = {"office": read_domain("office")[1], "shed": SHED, "crane": CRANE}


@pytest.mark.parametrize("search", [True, False])
@pytest.mark.parametrize("name", DOMAINS)
def test_the_reference_finds_the_plan_that_incremental_planning_finds(
    name: str, search: bool, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("asp.reasoning.planning.incremental.STATE_SET_SEARCH", search)
    known = knowledge(name, DOMAINS[name])
    reference = ReferencePlanner(known)
    incremental = IncrementalPlanner(DOMAINS[name], f"{name}.al")
    world, draw = world_of(known.description), random.Random(3)
    states, lengths = list(world.initial_states()), set()
    for _ in range(25):
        state = draw.choice(states)
        fluents = draw.sample(known.description.fluents, draw.choice([1, 2]))
        goal = tuple(draw.choice([fluent, fluent.complement]) for fluent in fluents)
        if not world.satisfies(state, goal):
            now = frozenset(world.true_atoms(state))
            found = reference.shortest(now, goal, 5)
            assert found == incremental.shortest(now, goal, 5), (now, goal)
            lengths.add(None if found is None else len(found))
    assert {1, 2} < lengths
