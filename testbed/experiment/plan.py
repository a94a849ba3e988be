"""From a configuration to the list of its trials: ids, seeds and rules, before anything runs.

What a trial's result may depend on is hashed into its id; the link, the number of workers and
the time allowed for an answer are not (one trial is the same trial wherever its robot runs).
"""

from __future__ import annotations

import hashlib
from collections.abc import Iterator, Sequence
from pathlib import Path

import msgspec
import numpy as np

from asp.levels import LevelSize
from testbed.config.grounds import grounds, level_size
from testbed.config.models import ExperimentConfig, KnowledgeKind, Pace
from testbed.environment.rules import Observability
from testbed.environment.world import World
from testbed.experiment.domains import load_world
from testbed.experiment.levels.drawing import Drawing
from testbed.experiment.record import COARSE
from testbed.experiment.repeating import repeats_of

PROTOCOL = "levels"
"""The protocol of trials at the fine resolution, in place of a scenario."""


class FineSetting(msgspec.Struct, frozen=True, kw_only=True):
    """What trials at the fine resolution have of their own.

    `size` is that of a level which is made, `refinement` else the file that refines the domain;
    `statistics` are probabilities by the name of the action.
    """

    size: LevelSize | None
    refinement: str | None
    statistics: dict[str, float]
    pace: Pace


class Setting(msgspec.Struct, frozen=True, kw_only=True, omit_defaults=True):
    """What holds in every trial of one scenario, or at one level, of a configuration.

    `script` is `((step, action), ...)`, or None for the scenario's triggers; `observability` is by
    the name of the exogenous action.
    """

    domain: str
    goal: tuple[str, ...]
    script: tuple[tuple[int, str], ...] | None
    observability: dict[str, Observability]
    knowledge: KnowledgeKind
    goal_feedback: bool
    exogenous_while_thinking: bool
    rate: float | None
    step_limit: int
    plan_limit: int
    decision_s: float | None
    fine: FineSetting | None = None


class TrialSpec(msgspec.Struct, frozen=True, kw_only=True):
    """One trial to play. `initial` holds the atoms true at step 0; all others are false."""

    trial: str
    pair: str
    scenario: str
    level: str
    seed: int
    robot: str
    initial: tuple[str, ...]
    domain: str
    setting: Setting


def plan_trials(config: ExperimentConfig) -> list[TrialSpec]:
    """The trials of a configuration in their order: scenario or level, pair, robot.

    Which robot of a pair is first follows from the pair's seed: what one of them has prepared can
    serve the other, which plays after it in the same process.
    """
    return list(_at_levels(config)) if config.is_fine else _in_scenarios(config)


def _in_scenarios(config: ExperimentConfig) -> list[TrialSpec]:
    world = load_world(config.domain)
    return [
        spec
        for scenario in config.scenarios
        for initial, repeat in _starts(config, scenario, world)
        for spec in _pair(config, scenario, initial, repeat, world.description.name)
    ]


def _at_levels(config: ExperimentConfig) -> Iterator[TrialSpec]:
    domain = Path(config.domain).stem
    for level, ground in grounds(config):
        drawing = Drawing(config, ground.refinement)
        texts = [ground.refinement.coarse.text, ground.text] if config.refinement else []
        for number in range(1, (config.limit or 0) + 1):
            place = [level, *texts, number]
            initial, goal = drawing.trial(generator_of(config.seed, place))
            path = [*place, list(initial), sorted(goal)]
            setting = _fine_setting(config, level, goal)
            yield from _specs(config, PROTOCOL, level, path, initial, setting, domain)


def _fine_setting(config: ExperimentConfig, level: str, goal: tuple[str, ...]) -> Setting:
    fine = FineSetting(
        size=None if config.refinement else level_size(config, level),
        refinement=config.refinement,
        statistics=dict(sorted(config.statistics.items())),
        pace=config.adversary.pace,
    )
    common = setting_of(config, PROTOCOL)
    return msgspec.structs.replace(common, goal=goal, fine=fine)


def generator_of(root: int, path: object) -> np.random.Generator:
    """What draws the trial at a seed path."""
    return np.random.default_rng(np.random.SeedSequence(root, spawn_key=_words(["draw", path])))


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
    sequence = np.random.SeedSequence(config.seed, spawn_key=_words(["limit", scenario]))
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
    return _specs(config, scenario, COARSE, path, initial, setting, domain)


def _specs(
    config: ExperimentConfig,
    scenario: str,
    level: str,
    path: Sequence[object],
    initial: tuple[str, ...],
    setting: Setting,
    domain: str,
) -> Iterator[TrialSpec]:
    """The trials of a pair, whose seed path this is: one a robot."""
    seed = trial_seed(config.seed, path)
    logical = [config.seed, path, _without_files(setting, domain)]
    first = seed % len(config.robots)
    for robot in (*config.robots[first:], *config.robots[:first]):
        yield TrialSpec(
            trial=_short_hash([*logical, robot]),
            pair=_short_hash(logical),
            scenario=scenario,
            level=level,
            seed=seed,
            robot=robot,
            initial=initial,
            domain=domain,
            setting=setting,
        )


def _without_files(setting: Setting, domain: str) -> object:
    """The setting as it is hashed: wherever its files lie."""
    fine = setting.fine and msgspec.structs.replace(setting.fine, refinement=None)
    return msgspec.to_builtins(msgspec.structs.replace(setting, domain=domain, fine=fine))


def setting_of(config: ExperimentConfig, scenario: str) -> Setting:
    """The rules of a scenario: its own settings where it has them, else the experiment's."""
    own = config.settings(scenario)
    assert own.goal is not None
    return Setting(
        domain=config.domain,
        goal=own.goal,
        script=None if own.script is None else tuple((e.step, e.action) for e in own.script),
        observability=config.rules_of_news(),
        knowledge=config.knowledge,
        goal_feedback=bool(own.goal_feedback),
        exogenous_while_thinking=bool(own.exogenous_while_thinking),
        rate=config.adversary.rate,
        step_limit=config.limits.steps,
        plan_limit=config.limits.plan,
        decision_s=config.limits.decision_s,
    )


def trial_seed(root: int, path: object) -> int:
    """The seed of the trials at a seed path: 32 bits that follow from the root seed and it."""
    sequence = np.random.SeedSequence(root, spawn_key=_words(path))
    return int(sequence.generate_state(1)[0])


def _words(path: object) -> tuple[int, ...]:
    digest = hashlib.blake2b(_canonical(path), digest_size=16).digest()
    return tuple(int.from_bytes(digest[i : i + 4], "big") for i in range(0, 16, 4))


def _short_hash(value: object) -> str:
    return hashlib.blake2b(_canonical(value), digest_size=6).hexdigest()


def _canonical(value: object) -> bytes:
    return msgspec.json.encode(value, order="deterministic")
