"""What a goal takes who knows the events of a trial: as in a search through all ways by hand."""

from math import inf
from pathlib import Path

import pytest

from asp.language import parse_description
from testbed.config import load_config
from testbed.experiment.plan import plan_trials
from testbed.experiment.record import TrialRecord
from testbed.experiment.robots import make_robot
from testbed.experiment.specs import TrialSpec
from testbed.experiment.trial import play_trial
from testbed.link import InProcessRobot
from testbed.world import world_of
from tests import games


def _specs(folder: Path, name: str, *given: str, **keys: object) -> list[TrialSpec]:
    file = games.config_of(folder, name, robots=["traditional"], **keys)
    return plan_trials(load_config(file, ["link=inprocess", *given]))


def _played(specs: list[TrialSpec]) -> list[TrialRecord]:
    robot = InProcessRobot(make_robot)
    return [play_trial(spec, robot).record for spec in specs]


@pytest.mark.parametrize("name", games.DOMAINS)
def test_it_is_the_least_of_all_ways(tmp_path: Path, name: str) -> None:
    adversary = {"strategy": "random", "rate": 0.5, "budget": 3}
    records = _played(_specs(tmp_path, name, adversary=adversary, repeats=12))
    world = world_of(parse_description(games.DOMAINS[name].text))
    costs = dict.fromkeys(world.agent_actions, 0) | dict(world.description.costs)
    assert {len(record.exogenous) for record in records} >= {1, 2}
    for record in records:
        start, events = world.state(record.initial), {e.step: e.action for e in record.exogenous}
        least = games.least_knowing(world, start, record.goal, costs, events)
        assert record.oracle_units == (None if least == inf else least)


def test_without_events_it_is_the_least(tmp_path: Path) -> None:
    (record,) = _played(_specs(tmp_path, "harbour", "adversary.strategy=none"))
    assert record.oracle_units == record.minimal_units == 13


@pytest.mark.parametrize("event", [[], [{"step": 1, "action": "drift(silk,west)"}]])
def test_where_the_bound_strikes_it_is_not_known(tmp_path: Path, event: list[object]) -> None:
    (record,) = _played(_specs(tmp_path, "harbour", "limits.judge_states=2", script=event))
    assert len(record.exogenous) == len(event)
    assert record.oracle_units is None
