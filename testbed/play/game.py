"""A game of a person: what is played, how it came out, and how it is kept.

The configuration of a game of the adversary has what the person did as a script, so that the game
can be replayed, and played again with other robots. That of a game of the robot names the robot
`human`, whose answers a replay takes from the record.
"""

from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import Any, Literal, NamedTuple

import msgspec

import agents.adversary.human
import agents.human
from testbed.config import (
    AdversarySettings,
    ConfigError,
    ExperimentConfig,
    ScriptEntry,
    conditions_of,
)
from testbed.config.sweep import Sweep
from testbed.experiment.plan import plan_trials, trials_of
from testbed.experiment.provenance import Provenance
from testbed.experiment.record import TrialRecord
from testbed.experiment.recorder import NAMED, Result, blank_record
from testbed.experiment.robots import HUMAN, make_robot
from testbed.experiment.run_folder import begin_or_resume
from testbed.experiment.specs import TrialSpec
from testbed.experiment.store import TrialWriter
from testbed.experiment.stories import decode, encode
from testbed.experiment.trial import play_trial
from testbed.experiment.trial_setup import setup_of
from testbed.link import InProcessRobot
from testbed.play.asking import Asker
from testbed.play.people import AdversaryAtKeyboard, Overheard, RobotAtKeyboard
from testbed.text import Say, counted

Side = Literal["adversary", "robot"]
"""The agent that the person plays."""


class Game(NamedTuple):
    """The trial to be played, the only one of its configuration, and who plays it."""

    config: ExperimentConfig
    spec: TrialSpec
    side: Side


def game_of(config: ExperimentConfig, side: Side) -> Game:
    """The game from the first start of a configuration, under the first condition of a sweep.

    Raises ConfigError for the fine resolution, at which no person plays.
    """
    own = next(iter(conditions_of(config).values()))
    if own.is_fine:
        key = "refinement" if own.refinement else "levels"
        raise ConfigError([f"{key}: a person plays at the coarse resolution; leave the key out"])
    start = next(trials_of(own))
    settings = own.settings(start.scenario)
    by_person: dict[str, Any] = {"strategy": HUMAN, "rate": None, "options": {}}
    adversary = own.adversary.model_copy(update=by_person if side == "adversary" else None)
    alone = own.model_copy(
        update={
            "protocol": None,
            "goal": settings.goal,
            "initial": start.initial,
            "scenarios": (start.scenario,),
            "scenario_settings": {},
            "robots": (own.robots[0] if side == "adversary" else HUMAN,),
            "baseline": None,
            "treatment": (),
            "repeats": 1,
            "limit": None,
            "goal_feedback": settings.goal_feedback,
            "exogenous_while_thinking": settings.exogenous_while_thinking,
            "script": None if side == "adversary" else settings.script,
            "adversary": adversary,
            "sweep": Sweep(),
        }
    )
    (spec,) = plan_trials(alone)
    return Game(alone, spec, side)


def introduction(game: Game) -> Iterator[str]:
    """What is said before the first step."""
    spec, other = game.spec, game.config.adversary.strategy or "the scenario's events"
    against = spec.robot if game.side == "adversary" else other
    yield f"you play the {game.side} against {against} in {spec.domain}, scenario {spec.scenario}"
    yield f"goal of the robot: {' '.join(spec.setting.goal)}"


def played(game: Game, asker: Asker, say: Say) -> Result:
    """The result of a game, in which the person is asked. Raises Quit."""
    spec, setup = game.spec, setup_of(game.spec.setting)
    core, robot = setup.core(spec.setting), Overheard(InProcessRobot(make_robot))
    if game.side == "robot":
        with agents.human.PERSON.of(RobotAtKeyboard(core, asker, say)):
            return play_trial(spec, robot)
    adversary = AdversaryAtKeyboard(core, robot, setup.teller(spec.trial), asker, say)
    with agents.adversary.human.PERSON.of(adversary):
        return play_trial(spec, robot, adversary.watch)


def conclusion(record: TrialRecord) -> Iterator[str]:
    """How a game came out, and the least that it takes with and without knowing the events."""
    reason = f": {record.reason}" if record.reason else ""
    actions, units = counted(record.action_count, "action"), _units(record.execution_units)
    yield f"outcome {record.outcome}{reason} after {counted(record.steps, 'step')}"
    yield f"  the robot    {actions}, {units}"
    if record.minimal_units is not None:
        fewest = counted(record.minimal_actions or 0, "action")
        yield f"  undisturbed  {fewest}, {_units(record.minimal_units)} at least"
    if record.oracle_units is not None:
        regret = _units(record.execution_units - record.oracle_units)
        own = f"; regret {regret}" if record.achieved else ""  # a failure is not cheap
        yield f"  knowing all  {_units(record.oracle_units)} at least{own}"


def _units(number: int) -> str:
    return counted(number, "execution unit")


def keep(game: Game, result: Result, folder: Path, command: Sequence[str]) -> str:
    """Keep a game as a run in a folder; the id of its trial. Raises StoreError and OSError."""
    config = game.config if game.side == "robot" else _scripted(game.config, result.record)
    (spec,) = plan_trials(config)
    assert spec.seed == game.spec.seed
    begin_or_resume(folder, config, resume=False)
    provenance = Provenance(folder, config, command)
    blank = blank_record(spec)
    own = {key: getattr(blank, key) for key in (*NAMED, "condition")}
    with TrialWriter(folder, [spec]) as writer:
        if result.story is not None:
            story = msgspec.structs.replace(decode(result.story), trial=spec.trial)
            writer.tell(encode(story))
        writer.append(msgspec.structs.replace(result.record, **own))
    provenance.close(0, workers=0)
    return spec.trial


def _scripted(config: ExperimentConfig, record: TrialRecord) -> ExperimentConfig:
    """The configuration in which the events of a record are a script."""
    bounds = config.adversary.model_dump(include=set(config.adversary.bounds()))
    script = tuple(ScriptEntry(step=own.step, action=own.action) for own in record.exogenous)
    return config.model_copy(update={"script": script, "adversary": AdversarySettings(**bounds)})
