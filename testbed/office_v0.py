"""The environment as PettingZoo users expect it: `env`, `raw_env`, `parallel_env`.

    from testbed import office_v0
    env = office_v0.env(config="configs/office.yaml", render_mode="ansi")

Of a configuration the environment uses domain, goal, initial, observability, goal_feedback,
exogenous_while_thinking, rewards, limits.steps, limits.judge_states, what bounds the adversary, and
infos, illegal and padded; scenarios and scripts are an adversary's business, and the adversary is
an agent here. Any key can be overridden: `env(goal_feedback=False)`. Of a sweep it is given one
condition. With `level="L3"`, or a configuration with a refinement, the robot acts at the fine
resolution.
"""

import json
from numbers import Integral
from os import PathLike, fspath
from typing import Any, TypeAlias

import numpy as np

from asp import load_description
from asp.language import suggestion
from testbed.config import ConfigError, ExperimentConfig, lists_keys, load_config, refinements
from testbed.environment import Core, EventRules, RandomGoal, Rewards, Rules, fine_core
from testbed.environment.aec import AECView, OrderedView
from testbed.environment.conventions import Conventions
from testbed.environment.parallel import ParallelView
from testbed.world import world_of

Config: TypeAlias = str | PathLike[str] | ExperimentConfig | None
"""A file, the bare name of a packaged configuration, one already read, or None: `office`, with a
level `levels`."""


@lists_keys
def env(config: Config = None, render_mode: str | None = None, **options: Any) -> OrderedView:
    """The AEC environment, wrapped: what is called out of order raises, too.

    Of the options `max_cycles` is the number of the last step, instead of limits.steps; `level` one
    of those of the configuration, by default of the packaged `levels`. Raises ConfigError for a bad
    configuration and ValueError for an unknown render mode.
    """
    return OrderedView(raw_env(config, render_mode, **options))


@lists_keys
def raw_env(config: Config = None, render_mode: str | None = None, **options: Any) -> AECView:
    """The AEC environment, unwrapped. Parameters, options and errors as for `env`."""
    core, conventions = make_game(config, **options)
    return AECView(core, render_mode, conventions)


@lists_keys
def parallel_env(
    config: Config = None, render_mode: str | None = None, **options: Any
) -> ParallelView:
    """The parallel environment. Parameters, options and errors as for `env`."""
    core, conventions = make_game(config, **options)
    return ParallelView(core, render_mode, conventions)


def make_core(config: Config = None, **options: Any) -> Core:
    """The game that a configuration describes. Options and errors as for `env`."""
    return make_game(config, **options)[0]


def make_game(
    config: Config = None, max_cycles: int | None = None, level: str | None = None, **overrides: Any
) -> tuple[Core, Conventions]:
    """The game, and how an environment is to show it. Raises ConfigError."""
    read = read_config(config, level, **overrides)
    return _core(read, max_cycles), Conventions(read.infos, read.illegal, read.padded)


def _core(read: ExperimentConfig, max_cycles: int | None) -> Core:
    if read.is_sweep:
        example = f'testbed.config.conditions_of(config)["{next(iter(read.sweep.cells))}"]'
        one = f"give one, as in {example}, or sweep={{}} for what they have in common"
        raise ConfigError([f"{read.name}: is a sweep of {read.sweep.size} conditions; {one}"])
    rules = Rules(
        goal=read.goal,
        steps=read.limits.steps if max_cycles is None else whole("max_cycles", max_cycles),
        observability=read.rules_of_news(),
        goal_feedback=read.goal_feedback,
        exogenous_while_thinking=read.exogenous_while_thinking,
        adversary=EventRules(**read.adversary.bounds()),
        rewards=Rewards(**dict(read.rewards)),
        search_states=read.limits.judge_states,
    )
    if read.is_fine:
        return _fine(read, rules)
    world = world_of(load_description(read.domain))
    initial = world.initial_states() if read.initial is None else (world.state(read.initial),)
    return Core(world, rules, initial)


def whole(name: str, given: Any) -> int:
    """A whole number from 1 on, also one of NumPy's. Raises ConfigError for anything else."""
    if isinstance(given, Integral) and not isinstance(given, bool) and int(given) >= 1:
        return int(given)
    wanted = f"should be a whole number from 1 on, not {given!r}"
    raise ConfigError([f"keyword argument: {name}: {wanted}"])


def _fine(config: ExperimentConfig, rules: Rules) -> Core:
    if len(config.levels) > 1:
        example = f"level='{config.levels[0]}'"
        raise ConfigError([f"{config.name}: there are several levels; give one, as in {example}"])
    ((_, refinement),) = refinements(config)
    world, sorts = world_of(refinement), refinement.description.sorts
    return fine_core(
        refinement,
        rules,
        config.statistics,
        config.adversary.pace,
        None if config.initial is None else (world.state(config.initial),),
        None if config.goal else RandomGoal(world, config.draw.goal, sorts),
        config.draw.holding,
    )


def read_config(
    config: Config = None, level: str | None = None, **overrides: Any
) -> ExperimentConfig:
    """The configuration of an environment. Parameters as for `env`.

    Raises ConfigError, also for what is neither a key of a configuration nor a parameter.
    """
    if isinstance(config, ExperimentConfig):
        if overrides or level:
            raise ValueError("overrides go with the name of a configuration, not with a read one")
        return config
    known = ExperimentConfig.model_fields.keys()
    unknown = [name for name in overrides if name.partition(".")[0] not in known]
    if unknown:
        choices = ("config", "render_mode", "max_cycles", "level", *known)
        lines = [f"{name}: unknown key; {suggestion(name, choices)}" for name in unknown]
        raise ConfigError([f"keyword argument: {line}" for line in lines])
    chosen = overrides if level is None else {**overrides, "levels": [level]}
    changes = [f"{key}={_written(key, value)}" for key, value in chosen.items()]
    packaged = "office" if level is None else "levels"
    source = packaged if config is None else str(config)
    return load_config(source, changes, given_in="keyword argument")


def _written(key: str, value: Any) -> str:
    """A value as an override has it. Raises ConfigError for one that no configuration can have."""
    try:
        return json.dumps(value, default=_plain)
    except (TypeError, ValueError) as error:
        wanted = "should be numbers, text, truth values, lists and dictionaries"
        raise ConfigError([f"keyword argument: {key}: {wanted}; {error}"]) from None


def _plain(value: Any) -> Any:
    """The Python value of NumPy's scalars and arrays, the text of a path. Raises TypeError."""
    if isinstance(value, np.generic | np.ndarray):
        return value.tolist()
    if isinstance(value, PathLike):
        return fspath(value)
    raise TypeError(f"{type(value).__name__} is none of these")
