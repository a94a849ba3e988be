"""All single-event branches of a trial: by a robot's snapshots, and by telling it all again."""

import time
from itertools import islice

from asp.language import Action
from benchmarks.measuring import no_collection
from benchmarks.sheets import DisagreementError, Row, Sheet
from testbed.config import load_config
from testbed.environment import Core
from testbed.experiment.plan import plan_trials
from testbed.experiment.robots import ROBOTS
from testbed.experiment.snapshots import Replayed, restorable_robot
from testbed.experiment.specs import TrialSpec
from testbed.experiment.trial_setup import setup_of
from testbed.protocol import NONE, Restorable

OFFICE = ("office", "scenarios=[none]", "limits.steps=40")
LEVEL = ("levels", "levels=[L2]", "limit=1", "adversary.rate=0", "statistics={}")
SETTINGS = (("intentional", OFFICE), ("traditional", OFFICE), ("intentional", LEVEL))
EVENTS = {"small": 1, "full": 4}
"""How many of the events that are legal at a step are tried."""
STEPS = (1, None)
"""How many decisions follow an event; None: those to the end of the trial."""


def main(size: str) -> list[Sheet]:
    """The sheet `branches`. Raises DisagreementError where both ways find other trials."""
    rows = [
        _row(robot, config, EVENTS[size], steps) for robot, config in SETTINGS for steps in STEPS
    ]
    notes = (
        "a trial is played without events; at each step events are tried one by one, and so many",
        "decisions follow. Process time; everything was grounded and asked for once before",
    )
    return [Sheet("branches", "Trials with one event", rows, notes)]


def _row(name: str, config: tuple[str, ...], events: int, steps: int | None) -> Row:
    spec = plan_trials(load_config(config[0], [*config[1:], f"robots=[{name}]"]))[0]
    _explored(spec, restorable_robot(name), events, steps)
    restored_ms, restored = _explored(spec, restorable_robot(name), events, steps)
    replayed_ms, replayed = _explored(spec, Replayed(name, ROBOTS.find(name)), events, steps)
    if restored != replayed:
        raise DisagreementError(f"{name} in {config[0]}")
    return {
        "configuration": config[0],
        "robot": name,
        "decisions": steps or "to the end",
        "branches": len(restored),
        "snapshots_ms": restored_ms / len(restored),
        "replayed_ms": replayed_ms / len(restored),
        "times_faster": replayed_ms / restored_ms,
    }


def _explored(
    spec: TrialSpec, robot: Restorable, events: int, steps: int | None
) -> tuple[float, list[list[Action]]]:
    """Milliseconds, and the robot's actions in each branch from the event on."""
    setup, found = setup_of(spec.setting), list[list[Action]]()
    core = setup.core(spec.setting)
    core.reset(seed=spec.seed, initial=spec.initial, trial=spec.trial)
    with no_collection():
        began = time.process_time()
        robot.begin(setup.task(spec, core.situation.state, 0))
        while core.situation.ending is None:
            action = robot.act(core.percept).action
            game, mind = core.snapshot(), robot.snapshot()
            legal = (event for event in core.legal_events(action) if event != NONE)
            for event in islice(legal, events):
                core.advance(action, event)
                found.append(_played(core, robot, steps))
                core.restore(game)
                robot.restore(mind)
            core.advance(action)
        return (time.process_time() - began) * 1e3, found


def _played(core: Core, robot: Restorable, steps: int | None) -> list[Action]:
    actions: list[Action] = []
    while core.situation.ending is None and len(actions) != steps:
        actions.append(robot.act(core.percept).action)
        core.advance(actions[-1])
    return actions
