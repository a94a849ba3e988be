"""From a configuration to the list of its trials, before anything runs."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from pathlib import Path

from asp.language import Description, Trigger
from testbed.config import ExperimentConfig
from testbed.experiment.domains import load_world
from testbed.experiment.level_plan import level_specs
from testbed.experiment.record import COARSE
from testbed.experiment.seeds import drawn_part
from testbed.experiment.specs import TrialSpec, pair_specs, setting_of
from testbed.world import World

__all__ = ["TrialSpec", "plan_trials", "planned_trials"]


def plan_trials(config: ExperimentConfig) -> list[TrialSpec]:
    """The trials of a configuration in their order: scenario or level, pair, robot."""
    return list(level_specs(config)) if config.is_fine else _in_scenarios(config)


def planned_trials(config: ExperimentConfig) -> dict[str, int]:
    """How many trials each scenario, or level, has in the plan, without drawing what they are."""
    robots = len(config.robots)
    if config.is_fine:
        own = [Path(config.refinement).stem] if config.refinement else []
        return dict.fromkeys((*own, *config.levels), (config.limit or 0) * robots)
    world = load_world(config.domain)
    return {
        scenario: sum(1 for _ in _starts(config, scenario, world)) * robots
        for scenario in config.scenarios
    }


def _in_scenarios(config: ExperimentConfig) -> list[TrialSpec]:
    world = load_world(config.domain)
    return [
        spec
        for scenario in config.scenarios
        for initial, repeat in _starts(config, scenario, world)
        for spec in _pair(config, scenario, initial, repeat, world.description.name)
    ]


def _starts(
    config: ExperimentConfig, scenario: str, world: World
) -> Iterator[tuple[tuple[str, ...], int]]:
    """Initial states, and which of the pairs from there this is, from 0 on."""
    given = config.settings(scenario).initial
    states = world.initial_states() if given is None else [world.state(given)]
    atoms = [tuple(sorted(world.true_atoms(state))) for state in states]
    repeats = _repeats(config, scenario, world.description)
    drawn = drawn_part(len(atoms) * repeats, config.limit, config.seed, scenario)
    return ((atoms[index // repeats], index % repeats) for index in drawn)


def _pair(
    config: ExperimentConfig, scenario: str, initial: tuple[str, ...], repeat: int, domain: str
) -> Iterator[TrialSpec]:
    setting = setting_of(config, scenario)
    path = [
        domain,
        COARSE,
        scenario,
        list(initial),
        sorted(setting.goal),
        *([repeat] * (repeat > 0)),
    ]
    return pair_specs(config, scenario, COARSE, path, initial, setting, domain)


def _repeats(config: ExperimentConfig, scenario: str, description: Description) -> int:
    """Pairs from each initial state of a scenario.

    What others do, and what the robot is told of it, is what a seed draws; where neither is left
    open, another pair would be the same trial again. (A domain whose actions have several outcomes
    is played once, too, unless something else is drawn.)
    """
    own = config.settings(scenario)
    triggers = [t for t in description.triggers if t.scenario == scenario]
    drawn = own.script is None and _events_are_drawn(config, triggers)
    return own.repeats or 1 if drawn or _news_is_drawn(config) else 1


def _events_are_drawn(config: ExperimentConfig, triggers: Sequence[Trigger]) -> bool:
    rate = config.adversary.rate
    if not config.plays_triggers:
        return rate != 0
    return any(t.drawn or _open(t.probability if rate is None else rate) for t in triggers)


def _news_is_drawn(config: ExperimentConfig) -> bool:
    rules = config.observability.values()
    return any(_open(own.probability) or own.false_reports > 0 for own in rules)


def _open(probability: float) -> bool:
    return 0.0 < probability < 1.0
