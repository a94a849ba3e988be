"""Whether actions have one outcome each, against the world's own transitions."""

from itertools import combinations

import pytest
from hypothesis import event, given, settings

from asp import parse_description
from asp.language import Description, read_domain
from asp.reasoning.determinism import Branching, branchings, deterministic_by_form
from asp.translation import translate
from testbed.world import World, world_of
from tests.asp.reasoning.branching import DIE, DOOR, descriptions

ROWS = """
sorts
  place = {a, b, c}.
fluents
  inertial at(place).
  inertial held.
actions
  agent go(place).
  agent drop.
laws
  go(P) causes at(P).
  drop causes -held.
  -at(P) if at(Q), P != Q.
"""
SOMEWHERE = "  -held if -at(a), -at(b), -at(c).\n"


def _branches(world: World) -> set[bool]:
    """Whether actions, and doing nothing, have outcomes beside a first, and beside no change."""
    found = set()
    for state in world.states():
        actions = (*world.agent_actions, *world.exogenous_actions)
        if any(len(world.successors(state, (action,))) > 1 for action in actions):
            found.add(True)
        if world.successors(state, ()) != (state,):
            found.add(False)
    return found


def _is_right(found: Branching, world: World) -> bool:
    state = world.state(_complete(found.state, world))
    after = world.successors(state, () if found.action is None else (found.action,))
    outcomes = {world.state(_complete(outcome, world)) for outcome in found.outcomes}
    if found.action is None:
        return outcomes <= set(after) - {state}
    return len(outcomes) == 2 and outcomes <= set(after)


def _complete(true: frozenset[str], world: World) -> list[str]:
    return [fluent if fluent in true else fluent.complement for fluent in world.fluents]


@settings(max_examples=100)
@given(description=descriptions())
def test_a_witness_is_found_where_there_is_one_and_nowhere_else(description: Description) -> None:
    world = world_of(description)
    found = branchings(description, translate(description.source, "random.al"))
    assert {each.action is not None for each in found} == _branches(world)
    assert all(_is_right(each, world) for each in found)
    event(f"witnesses: {len(found)}")


@settings(max_examples=100)
@given(description=descriptions())
def test_what_the_form_of_the_laws_shows_is_so_for_all_actions_together(
    description: Description,
) -> None:
    by_form = deterministic_by_form(description)
    event(f"by form: {by_form}")
    if not by_form:
        return
    world = world_of(description)
    actions = (*world.agent_actions, *world.exogenous_actions)
    for state in world.states():
        assert world.successors(state, ()) == (state,)
        for number in range(1, len(actions) + 1):
            for together in combinations(actions, number):
                assert len(world.successors(state, together)) <= 1


@pytest.mark.parametrize("more", ["", SOMEWHERE])
def test_values_that_exclude_each_other_make_no_outcomes(more: str) -> None:
    assert deterministic_by_form(parse_description(ROWS + more, "rows.al"))


@pytest.mark.parametrize("name", ["office", "library", "level"])
def test_the_packaged_domains_are_deterministic_by_form(name: str) -> None:
    file, text = read_domain(name)
    assert deterministic_by_form(parse_description(text, file))


@pytest.mark.parametrize(("text", "action"), [(DIE, "throw"), (DOOR, "pull")])
def test_the_witness_names_the_one_action_that_branches(text: str, action: str) -> None:
    (found,) = branchings(parse_description(text, "own.al"), translate(text, "own.al"))
    assert found.action == action
