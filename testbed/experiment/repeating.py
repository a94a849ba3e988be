"""How often a scenario is played from one initial state: once, where no seed makes a difference."""

from __future__ import annotations

from collections.abc import Sequence

from asp.language import Description, Trigger
from testbed.config import ExperimentConfig


def repeats_of(config: ExperimentConfig, scenario: str, description: Description) -> int:
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
