"""The condition that trials are played under: in words, and what a published one has otherwise."""

import json
from collections.abc import Callable, Collection, Mapping

from agents.adversary import RANDOM_RATE
from asp.language import read_domain
from testbed.config import (
    NO_EVENTS,
    ExperimentConfig,
    Observability,
    ScenarioSettings,
    conditions_of,
)
from testbed.experiment.timeline import in_words
from testbed.text import listed

NO_RESULT = {"answer_s"}
"""Limits on which no logical result depends."""
UNSEEN = Observability()
NO_ACTIONS = "no exogenous actions"
_KNOWN = {
    "complete": "complete knowledge of the initial state",
    "seen": "of the initial state only what is seen is known",
}


def condition(config: ExperimentConfig) -> str:
    """One line: what robots know and heed, what others do, limits and statistics.

    Of a sweep what is the same under each condition, and the keys that it varies.
    """
    parts = zip(*map(_parts, conditions_of(config).values()), strict=True)
    same = [own[0] for own in parts if len(set(own)) == 1]
    return "; ".join(part for part in (*same, _varied(config)) if part)


def _parts(config: ExperimentConfig) -> list[str]:
    """What there is to say of a configuration without a sweep, in a fixed order."""
    return [
        _observability(config),
        _of_scenarios(config, lambda own: f"{'' if own.goal_feedback else 'no '}goal feedback"),
        _of_scenarios(config, lambda own: _adversary(config, own)),
        _KNOWN[config.knowledge],
        f"relevance: {config.relevance}",
        "" if config.plans == "optimistic" else f"plans: {config.plans}",
        "" if config.ties is None else f"ties among explanations by an order of seed {config.ties}",
        "limits: " + ", ".join(_limit(key, value) for key, value in _limits(config).items()),
        ", ".join(f"{name} comes out with {p}" for name, p in config.statistics.items()),
    ]


def _varied(config: ExperimentConfig) -> str:
    """The keys that a sweep varies."""
    keys = dict.fromkeys(key for own in config.sweep.cells.values() for key in own)
    return f"varied by the sweep: {', '.join(keys)}" if keys else ""


def deviations(config: ExperimentConfig, published: ExperimentConfig) -> tuple[str, ...]:
    """In what a configuration is not the one that plays a study as it was published.

    How many trials are played, of which of its scenarios or levels, by which further robots and
    with which seed makes no difference.
    """
    robots = published.robots
    own, theirs = _rules(config, robots), _rules(published, robots)
    return tuple(name for name, value in own.items() if value != theirs[name])


def _rules(config: ExperimentConfig, robots: Collection[str]) -> Mapping[str, object]:
    adversary = config.adversary
    strategy = adversary.strategy or ("random" if config.is_fine else "triggers")
    played = [config.settings(name) for name in config.scenarios] or [config.settings("")]
    return {
        "domain": (read_domain(config.domain)[1], config.refinement),
        "goal": {frozenset(own.goal or ()) for own in played},
        "initial state": {own.initial for own in played},
        "robots": not set(robots) - set(config.robots),
        "observability": {n: o for n, o in config.observability.items() if o != UNSEEN},
        "goal feedback": {own.goal_feedback for own in played},
        "knowledge": config.knowledge,
        "relevance": config.relevance,
        "plans": config.plans,
        "ties": config.ties,
        "adversary": (
            {(own.script, own.exogenous_while_thinking) for own in played},
            adversary.model_copy(update={"strategy": strategy}),
        ),
        "limits": _limits(config),
        "statistics": config.statistics,
        "draw": config.draw if config.is_fine else None,
        "sweep": config.sweep,
    }


def _limits(config: ExperimentConfig) -> dict[str, object]:
    limits = config.limits.model_dump(exclude=NO_RESULT)
    return {key: value for key, value in limits.items() if value is not None}


def _limit(key: str, value: object) -> str:
    """`steps 100`; a time with its unit: `decision_s` is `decision 30.0 s`."""
    seconds = key.removesuffix("_s")
    return f"{in_words(key)} {value}" if seconds == key else f"{in_words(seconds)} {value} s"


def _observability(config: ExperimentConfig) -> str:
    told = {name: own for name, own in config.observability.items() if own != UNSEEN}
    if not told:
        return "told of no exogenous action"
    return "told of " + ", ".join(f"{name} ({_news(own)})" for name, own in told.items())


def _news(own: Observability) -> str:
    given = own.model_dump(exclude_defaults=True)
    return ", ".join([own.mode, *(f"{in_words(k)} {v}" for k, v in given.items() if k != "mode")])


def _adversary(config: ExperimentConfig, own: ScenarioSettings) -> str:
    thinking = ", also while the robot thinks" if own.exogenous_while_thinking else ""
    return f"{_strategy(config, own)}{thinking}{_bounds(config)}"


def _bounds(config: ExperimentConfig) -> str:
    """The rules for the adversary, as far as there are any."""
    bounds = set(config.adversary.bounds())
    given = config.adversary.model_dump(mode="json", include=bounds, exclude_defaults=True)
    return "".join(f", {in_words(name)} {json.dumps(value)}" for name, value in given.items())


def _strategy(config: ExperimentConfig, own: ScenarioSettings) -> str:
    rate = config.adversary.rate
    if own.script is not None:
        return "exogenous actions by script" if own.script else NO_ACTIONS
    options = "".join(f", {name} {value}" for name, value in config.adversary.options.items())
    at_rate = "" if rate is None else f" at rate {rate}"
    if config.plays_triggers:
        return f"exogenous actions by triggers{at_rate}"
    if config.adversary.strategy in (None, "random"):
        by_default = 0.0 if config.is_fine else RANDOM_RATE
        drawn = by_default if rate is None else rate
        return f"random exogenous actions at rate {drawn}{options}" if drawn else NO_ACTIONS
    if config.adversary.strategy == NO_EVENTS:
        return NO_ACTIONS
    return f"exogenous actions by {config.adversary.strategy}{at_rate}{options}"


def _of_scenarios(config: ExperimentConfig, said: Callable[[ScenarioSettings], str]) -> str:
    """What is said of the scenarios, once where it is the same of all of them."""
    where: dict[str, list[str]] = {}
    for name in config.scenarios or ("",):
        where.setdefault(said(config.settings(name)), []).append(name)
    if len(where) == 1:
        return next(iter(where))
    return "; ".join(f"{words} in {listed(names)}" for words, names in where.items())
