"""Cases: the trials of a configuration with the events left open, and back to configurations."""

from collections.abc import Iterator, Sequence
from dataclasses import asdict
from typing import TypeVar

import msgspec
import numpy as np

from asp.language import Literal
from testbed import environment
from testbed.config import ExperimentConfig, Observability, ScriptEntry, conditions_of
from testbed.experiment.plan import trials_of
from testbed.experiment.record import COARSE
from testbed.experiment.seeds import short_hash, trial_seed
from testbed.experiment.specs import Setting, TrialSpec, without_paths
from testbed.experiment.trial_setup import refinement_of, setup_of
from testbed.world import World

T = TypeVar("T")

SCENARIO = "stress"
"""What stands in place of a scenario."""
MODES: Sequence[environment.Mode] = ("never", "colocated", "always")
LONGEST_WALK, MOST_LITERALS = 12, 3
"""Of a goal that is drawn: actions that lead to it, and its literals."""


def cases_of(config: ExperimentConfig) -> list[TrialSpec]:
    """The trials of a configuration that differ in more than what others do, each once.

    Events are fair where `stress.fair` or `adversary.fair` says so.
    """
    fair = config.stress.fair or config.adversary.fair
    found: dict[str, TrialSpec] = {}
    for spec in trials_of(config):
        setting = msgspec.structs.replace(
            spec.setting,
            script=(),
            script_at_actions=(),
            script_skips=True,
            strategy=None,
            options=None,
            rate=_rate(spec.setting),
            fair=fair,
        )
        case = case_of(config.seed, spec, setting=setting)
        found.setdefault(case.trial, case)
    return list(found.values())


def _rate(setting: Setting) -> float | None:
    """How likely events are per step, where these are drawn by nothing but a rate."""
    is_drawn = setting.strategy == "random" or (
        setting.strategy is None and setting.fine is not None
    )
    return setting.rate if is_drawn and not setting.options else None


def case_of(root: int, spec: TrialSpec, **changes: object) -> TrialSpec:
    """A case with these changes, its id, and the seed of the trial that its configuration has."""
    scenario = SCENARIO if spec.level == COARSE else spec.scenario
    case = msgspec.structs.replace(spec, scenario=scenario, **changes)
    own = [case.robot, case.level, case.initial, without_paths(case.setting, case.domain)]
    trial, seed = short_hash(own), trial_seed(root, _path(case))
    return msgspec.structs.replace(case, trial=trial, pair=trial, seed=seed)


def _path(case: TrialSpec) -> list[object]:
    """The seed path of the one trial of the case's configuration (`testbed.experiment.plan`)."""
    fine, start = case.setting.fine, [list(case.initial), sorted(case.setting.goal)]
    if fine is None:
        return [case.domain, COARSE, case.scenario, *start]
    refinement = refinement_of(case.setting)
    texts = [refinement.coarse.text, refinement.text] if fine.refinement else []
    return [case.level, *texts, 1, *start]


def configuration_of(config: ExperimentConfig, spec: TrialSpec, name: str) -> ExperimentConfig:
    """The configuration with one trial: that of a case of `config`, with the events as a script."""
    own, setting = conditions_of(config)[spec.cell], spec.setting
    adversary: dict[str, object] = {
        "strategy": None,
        "options": {},
        "rate": setting.rate,
        "fair": setting.fair,
    }
    told = {key: Observability(**asdict(of)) for key, of in setting.observability.items()}
    coarse = setting.fine is None
    return own.model_copy(
        update={
            "name": name,
            "protocol": None,
            "scenarios": (spec.scenario,) if coarse else (),
            "scenario_settings": {},
            "levels": (spec.level,) if own.levels else (),
            "initial": spec.initial,
            "goal": setting.goal,
            "script": tuple(
                ScriptEntry(step=step, action=event) for step, event in setting.script or ()
            ),
            "script_policy": "skip",
            "observability": told,
            "goal_feedback": setting.goal_feedback,
            "exogenous_while_thinking": setting.exogenous_while_thinking,
            "adversary": own.adversary.model_copy(update=adversary),
            "robots": (spec.robot,),
            "baseline": None,
            "treatment": (),
            "repeats": 1,
            "limit": None if coarse else 1,
            "link": "inprocess",
            "stress": config.stress,
        }
    )


def drawn_case(config: ExperimentConfig, case: TrialSpec, draw: np.random.Generator) -> TrialSpec:
    """A case of the coarse resolution in which what `stress.vary` lists is drawn."""
    vary, setting, initial = config.stress.vary, case.setting, case.initial
    world = setup_of(setting).world
    changed: dict[str, object] = {}
    if "initial" in vary:
        states = world.initial_states()
        initial = _atoms(world, states[int(draw.integers(len(states)))])
    if "goal" in vary:
        changed["goal"] = _goal(world, world.state(initial), draw) or setting.goal
    if "observability" in vary:
        events = sorted({event.name for event in world.exogenous_actions})
        changed["observability"] = {
            name: environment.Observability(mode=_one(MODES, draw)) for name in events
        }
    if "goal_feedback" in vary:
        changed["goal_feedback"] = bool(draw.integers(2))
    setting = msgspec.structs.replace(setting, **changed)
    return case_of(config.seed, case, setting=setting, initial=initial)


def _goal(world: World, start: int, draw: np.random.Generator) -> tuple[Literal, ...]:
    """Literals that come to hold on a random walk of the robot; none where it leads nowhere."""
    state = start
    for _ in range(int(draw.integers(1, LONGEST_WALK + 1))):
        reached = sorted({after for _, after in world.moves(state)})
        state = _one(reached, draw) if reached else state
    inertial = frozenset(world.description.inertial)
    new = [own for own in _literals(world, state, start) if own.atom in inertial]
    count = min(len(new), int(draw.integers(1, MOST_LITERALS + 1)))
    chosen = sorted(int(number) for number in draw.permutation(len(new))[:count])
    return tuple(new[number] for number in chosen)


def _literals(world: World, state: int, start: int) -> Iterator[Literal]:
    """The literals that hold in a state and not at the start, the true atoms among them first."""
    here, before = (frozenset(world.true_atoms(own)) for own in (state, start))
    yield from sorted(here - before)
    yield from (atom.complement for atom in sorted(before - here))


def _atoms(world: World, state: int) -> tuple[Literal, ...]:
    return tuple(sorted(world.true_atoms(state)))


def _one(values: Sequence[T], draw: np.random.Generator) -> T:
    return values[int(draw.integers(len(values)))]
