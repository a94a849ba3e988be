"""The program of a decision where actions have several outcomes."""

import pytest

from agents.intentional import IntentionalRobot, program_of
from agents.intentional.programs import Decided
from asp import parse_description
from testbed.world import world_of
from tests.agents.intentional.branching_lives import live
from tests.asp.reasoning.branching import DIE
from tests.literals import parsed
from tests.solved_programs import found_by_clingo


@pytest.mark.parametrize("seed", range(3))
@pytest.mark.parametrize("seen", [None, ["thrown"]])
def test_clingo_finds_the_state_that_is_believed_among_several(
    seen: list[str] | None, seed: int
) -> None:
    description = parse_description(DIE, "die.al")
    start = world_of(description).state(parsed(["up(one)", "-up(two)", "-up(three)", "-thrown"]))
    told: list[tuple[str, Decided]] = []
    robot = IntentionalRobot()
    robot.watcher = lambda decided: told.append((program_of(decided), decided))
    live(robot, description, start, ["up(two)", "thrown"], seen=seen, seed=seed, steps=8)
    assert told
    for program, decided in told:
        found, intention = found_by_clingo(program), decided.intention
        assert found.intention == intention.action
        assert found.plan == ([*intention.plan] if intention.action.name == "start" else [])
        assert found.believed == intention.believed
