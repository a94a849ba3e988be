"""The environment as PettingZoo users expect it: `env`, `raw_env`, `parallel_env`.

    from testbed import office_v0
    env = office_v0.env(config="configs/office.yaml", render_mode="ansi")

Of a configuration the environment uses domain, goal, initial, observability, goal_feedback,
exogenous_while_thinking and limits.steps; scenarios and scripts are an adversary's business, and
the adversary is an agent here. Any key can be overridden: `env(goal_feedback=False)`. With
`level="L3"`, or a configuration with a refinement, the robot acts at the fine resolution.
"""

from __future__ import annotations

import json
from collections.abc import Iterable
from os import PathLike
from typing import TypeAlias

from asp import load_description
from asp.language import suggestion
from testbed.config import ConfigError, ExperimentConfig, grounds, lists_keys, load_config
from testbed.environment import (
    AECView,
    Core,
    OrderedView,
    ParallelView,
    RandomGoal,
    Rules,
    fine_core,
)
from testbed.world import world_of

Config: TypeAlias = str | PathLike[str] | ExperimentConfig | None
"""A file, the bare name of a packaged configuration, one already read, or None: `office`, with a
level `levels`."""


@lists_keys
def env(
    config: Config = None,
    render_mode: str | None = None,
    max_cycles: int | None = None,
    level: str | None = None,
    **overrides: object,
) -> OrderedView:
    """The AEC environment, wrapped: what is called out of order raises, too.

    `max_cycles` is the number of the last step, instead of limits.steps; `level` one of those of
    the configuration, by default of the packaged `levels`. Raises ConfigError for a bad
    configuration and ValueError for an unknown render mode.
    """
    return OrderedView(raw_env(config, render_mode, max_cycles, level, **overrides))


@lists_keys
def raw_env(
    config: Config = None,
    render_mode: str | None = None,
    max_cycles: int | None = None,
    level: str | None = None,
    **overrides: object,
) -> AECView:
    """The AEC environment, unwrapped. Parameters and errors as for `env`."""
    return AECView(make_core(config, max_cycles, level, **overrides), render_mode)


@lists_keys
def parallel_env(
    config: Config = None,
    render_mode: str | None = None,
    max_cycles: int | None = None,
    level: str | None = None,
    **overrides: object,
) -> ParallelView:
    """The parallel environment. Parameters and errors as for `env`."""
    return ParallelView(make_core(config, max_cycles, level, **overrides), render_mode)


def make_core(
    config: Config = None,
    max_cycles: int | None = None,
    level: str | None = None,
    **overrides: object,
) -> Core:
    """The game that a configuration describes. Raises ConfigError."""
    read = _read(config, level, overrides)
    return _fine(read, max_cycles) if read.is_fine else _coarse(read, max_cycles)


def _coarse(config: ExperimentConfig, max_cycles: int | None) -> Core:
    world = world_of(load_description(config.domain))
    given = config.initial
    states = world.initial_states() if given is None else (world.state(given),)
    return Core(world, _rules(config, max_cycles), states)


def _fine(config: ExperimentConfig, max_cycles: int | None) -> Core:
    if len(config.levels) > 1:
        example = f"level='{config.levels[0]}'"
        raise ConfigError([f"{config.name}: there are several levels; give one, as in {example}"])
    ((_, ground),) = grounds(config)
    refinement = ground.refinement
    world, sorts = world_of(refinement), refinement.description.sorts
    return fine_core(
        refinement,
        _rules(config, max_cycles),
        config.statistics,
        config.adversary.pace,
        None if config.initial is None else (world.state(config.initial),),
        None if config.goal else RandomGoal(world, config.draw.goal, sorts),
        config.draw.holding,
    )


def _read(config: Config, level: str | None, overrides: dict[str, object]) -> ExperimentConfig:
    if isinstance(config, ExperimentConfig):
        if overrides or level:
            raise ValueError("overrides go with the name of a configuration, not with a read one")
        return config
    _check_keywords(overrides)
    chosen = overrides if level is None else {**overrides, "levels": [level]}
    changes = [f"{key}={json.dumps(value)}" for key, value in chosen.items()]
    packaged = "office" if level is None else "levels"
    source = packaged if config is None else str(config)
    return load_config(source, changes, given_in="keyword argument")


def _check_keywords(overrides: Iterable[str]) -> None:
    """Raises ConfigError for what is neither a key of a configuration nor a parameter here."""
    parameters = ("config", "render_mode", "max_cycles", "level")
    known = ExperimentConfig.model_fields.keys()
    lines = [
        f"keyword argument: {name}: unknown key; {suggestion(name, [*parameters, *known])}"
        for name in overrides
        if name.partition(".")[0] not in known
    ]
    if lines:
        raise ConfigError(lines)


def _rules(config: ExperimentConfig, max_cycles: int | None) -> Rules:
    return Rules(
        goal=config.goal,
        steps=config.limits.steps if max_cycles is None else max_cycles,
        observability=config.rules_of_news(),
        goal_feedback=config.goal_feedback,
        exogenous_while_thinking=config.exogenous_while_thinking,
    )
