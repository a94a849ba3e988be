"""From a configuration to the list of its trials, before anything runs."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from pathlib import Path

import numpy as np

from testbed.config import ExperimentConfig
from testbed.experiment.domains import load_world
from testbed.experiment.level_plan import level_specs
from testbed.experiment.record import COARSE
from testbed.experiment.repeating import repeats_of
from testbed.experiment.specs import TrialSpec, pair_specs, seed_words, setting_of
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
    repeats = repeats_of(config, scenario, world.description)
    drawn = _drawn(len(atoms) * repeats, config, scenario)
    return ((atoms[index // repeats], index % repeats) for index in drawn)


def _drawn(count: int, config: ExperimentConfig, scenario: str) -> Sequence[int]:
    """Which of `count` pairs to play: a smaller limit draws a part of what a larger one does."""
    if config.limit is None or config.limit >= count:
        return range(count)
    sequence = np.random.SeedSequence(config.seed, spawn_key=seed_words(["limit", scenario]))
    order = np.random.default_rng(sequence).permutation(count)
    return sorted(int(index) for index in order[: config.limit])


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
