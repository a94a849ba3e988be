"""TP where actions have several outcomes: both ways of reasoning agree."""

import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from agents.traditional import TraditionalRobot
from agents.traditional.reasoners import IncrementalReasoner, ReferenceReasoner
from asp import parse_description
from asp.language import Description
from testbed.protocol import Plans, RobotStops
from testbed.world import world_of
from tests.agents.both_ways import both_ways
from tests.agents.intentional.branching_lives import live
from tests.asp.reasoning.branching import DEFINED, INERTIAL, descriptions

FLUENTS = (*INERTIAL, *DEFINED)
BOTH = both_ways(IncrementalReasoner, ReferenceReasoner)


@pytest.mark.parametrize("plans", ["optimistic", "conformant"])
@settings(max_examples=25)
@given(
    description=descriptions(),
    goal=st.sampled_from(FLUENTS),
    seen=st.sets(st.sampled_from(FLUENTS)),
    events=st.booleans(),
    draw=st.data(),
    seed=st.integers(0, 99),
)
def test_every_decision_of_a_life_is_the_same(
    plans: Plans,
    description: Description,
    goal: str,
    seen: set[str],
    events: bool,
    draw: st.DataObject,
    seed: int,
) -> None:
    shows = [f"  {action} shows {fluent}." for action in ("tip", "wipe", "lift") for fluent in seen]
    source = "\n".join([description.source, "shows" if shows else "", *shows, ""])
    description = parse_description(source, "random.al")
    states = list(world_of(description).states())
    assume(states)
    initial = draw.draw(st.sampled_from(states))
    robot = TraditionalRobot(BOTH)
    try:
        live(robot, description, initial, [goal], plans=plans, seen=seen, events=events, seed=seed)
    except RobotStops:
        return
