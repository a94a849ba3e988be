"""The specification of a trial: its setting, and the id that follows from it.

What a trial's result may depend on is hashed into its id; the link, the number of workers and
the time allowed for an answer are not (one trial is the same trial wherever its robot runs).
"""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import fields
from functools import cache
from pathlib import Path
from typing import Any

import msgspec

from asp.domains import LevelSize
from asp.language import Action, Literal
from testbed.config import TRIGGERS, ExperimentConfig, Limits, ScriptEntry
from testbed.environment import EventRules, Observability, Pace
from testbed.experiment.seeds import playing_order, short_hash, trial_seed
from testbed.protocol import Knowledge, Plans, Relevance

BUDGETS = ("decision_s", "conflicts", "ground_rules", "expansions")
"""Limits of a decision, which the robot is told of by the same names."""


class FineSetting(msgspec.Struct, frozen=True, kw_only=True):
    """What trials at the fine resolution have of their own.

    `size` is that of a level which is made, `refinement` else the file that refines the domain;
    `statistics` are probabilities by the name of the action.
    """

    size: LevelSize | None
    refinement: str | None
    statistics: dict[str, float]
    pace: Pace


class Setting(msgspec.Struct, frozen=True, kw_only=True):
    """What holds in every trial of one scenario, or at one level, of a configuration.

    `script` is `((step, action), ...)`, or None for the `strategy` of an adversary, None being the
    scenario's triggers, at levels random events; `script_at_actions` has numbers of the
    robot's physical actions in place of steps. `observability` is by the name of the exogenous
    action. `budget`, `per_object`, `cooldown`, `cost`, `events` and `fair` are the rules for the
    adversary.
    """

    domain: str
    goal: tuple[Literal, ...]
    script: tuple[tuple[int, Action], ...] | None
    observability: dict[str, Observability]
    knowledge: Knowledge
    goal_feedback: bool
    exogenous_while_thinking: bool
    rate: float | None
    step_limit: int
    plan_limit: int
    decision_s: float | None
    conflicts: int | None
    ground_rules: int | None
    expansions: int | None
    relevance: Relevance
    fine: FineSetting | None = None
    strategy: str | None = None
    options: dict[str, Any] | None = None
    judge_states: int = Limits().judge_states
    script_at_actions: tuple[tuple[int, Action], ...] = ()
    script_skips: bool = False
    plans: Plans = "optimistic"
    ties: int | None = None
    budget: int | None = None
    per_object: dict[str, int] | None = None
    cooldown: int = 0
    cost: float = 0.0
    events: tuple[str, ...] | None = None
    fair: bool = False


class TrialSpec(msgspec.Struct, frozen=True, kw_only=True):
    """One trial to play. `initial` holds the atoms true at step 0; all others are false.

    `cell` is the name of the sweep's condition that it is played under, "" where nothing is swept.
    """

    trial: str
    pair: str
    scenario: str
    level: str
    seed: int
    robot: str
    initial: tuple[Literal, ...]
    domain: str
    setting: Setting
    cell: str = ""


def setting_of(config: ExperimentConfig, scenario: str) -> Setting:
    """The rules of a scenario: its own settings where it has them, else the experiment's."""
    own = config.settings(scenario)
    assert own.goal is not None
    adversary = config.adversary
    by_default = adversary.strategy == default_strategy(config.is_fine)
    return Setting(
        domain=config.domain,
        goal=own.goal,
        script=None if own.script is None else _numbered(own.script, "step"),
        observability=config.rules_of_news(),
        knowledge=config.knowledge,
        goal_feedback=bool(own.goal_feedback),
        exogenous_while_thinking=bool(own.exogenous_while_thinking),
        rate=adversary.rate,
        step_limit=config.limits.steps,
        plan_limit=config.limits.plan,
        **{name: getattr(config.limits, name) for name in BUDGETS},
        strategy=None if by_default else adversary.strategy,
        options=adversary.options or None,
        judge_states=config.limits.judge_states,
        script_at_actions=_numbered(own.script or (), "at_action"),
        script_skips=config.script_policy == "skip",
        relevance=config.relevance,
        plans=config.plans,
        ties=config.ties,
        **adversary.bounds() | {"per_object": adversary.per_object or None},
    )


def event_rules(setting: Setting) -> EventRules:
    """The rules for the adversary, as the environment has them."""
    given = {field.name: getattr(setting, field.name) for field in fields(EventRules)}
    return EventRules(**given | {"per_object": setting.per_object or {}})


def default_strategy(fine: bool) -> str:
    """The adversary's strategy in a configuration that gives none."""
    return "random" if fine else TRIGGERS


def _numbered(script: Sequence[ScriptEntry], key: str) -> tuple[tuple[int, Action], ...]:
    """The entries whose moment is said by this key, with its value."""
    moments = ((getattr(entry, key), entry.action) for entry in script)
    return tuple((number, action) for number, action in moments if number is not None)


def pair_specs(
    config: ExperimentConfig,
    scenario: str,
    level: str,
    path: Sequence[object],
    initial: tuple[Literal, ...],
    setting: Setting,
    domain: str,
) -> Iterator[TrialSpec]:
    """The trials of a pair, whose seed path this is: one a robot.

    Which robot is first follows from the pair's seed (`playing_order`).
    """
    seed = trial_seed(config.seed, path)
    logical = [config.seed, path, _without_files(setting, domain)]
    for robot in playing_order(seed, config.robots):
        yield TrialSpec(
            trial=short_hash([*logical, robot]),
            pair=short_hash(logical),
            scenario=scenario,
            level=level,
            seed=seed,
            robot=robot,
            initial=initial,
            domain=domain,
            setting=setting,
        )


def without_paths(setting: Setting, domain: str) -> Setting:
    """The same wherever its files lie: the domain by its name, a map by that of its file."""
    fine = setting.fine
    if fine is not None and fine.refinement is not None:
        fine = msgspec.structs.replace(fine, refinement=Path(fine.refinement).stem)
    return msgspec.structs.replace(setting, domain=domain, fine=fine)


@cache
def _defaults() -> Mapping[str, Any]:
    return {field.name: field.default for field in msgspec.structs.fields(Setting)}


def _without_files(setting: Setting, domain: str) -> object:
    """The setting as it is hashed: wherever its files lie, and without what is as by default."""
    fine = setting.fine and msgspec.structs.replace(setting.fine, refinement=None)
    own = msgspec.structs.replace(setting, domain=domain, fine=fine)
    values = msgspec.to_builtins(own, enc_hook=str)
    # msgspec omits a default that is the same object, which an equal number need not be.
    given = {name: value for name, value in values.items() if value != _defaults()[name]}
    if given.get("strategy") == "random":  # ids are older than other strategies
        given["random_events"] = bool(given.pop("strategy"))
    if given["relevance"] == "published":  # ids are older than the key
        del given["relevance"]
    return given
