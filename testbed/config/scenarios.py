"""Which scenarios a configuration plays, and whether there are such scenarios."""

from __future__ import annotations

from collections.abc import Collection, Iterator

from asp.language import suggestion
from testbed.config.models import NONE, ExperimentConfig, ScenarioSettings
from testbed.config.words import Finding

SCRIPT, RANDOM = "script", "random"
"""Names of the one scenario of a run without scenarios that has a script, or random events."""


def scenarios_of(config: ExperimentConfig, known: tuple[str, ...]) -> tuple[str, ...]:
    """The scenarios that are played: those given, or what there is to play in a domain.

    `known` are the domain's. Where there is neither a script nor a random event nor a scenario of
    the domain, nothing exogenous happens.
    """
    if config.scenarios:
        return config.scenarios
    if config.script is not None:
        return (SCRIPT,)
    return (RANDOM,) if config.has_random_events else known or (NONE,)


def with_scenarios(config: ExperimentConfig, known: tuple[str, ...]) -> ExperimentConfig:
    """The configuration with all scenarios that it plays, `none` with a script without entries."""
    scenarios = scenarios_of(config, known)
    found: dict[str, object] = {"scenarios": scenarios}
    if NONE in scenarios and not _is_played(NONE, config, known):
        own = config.scenario_settings.get(NONE, ScenarioSettings())
        nothing = own.model_copy(update={"script": ()})
        found["scenario_settings"] = {**config.scenario_settings, NONE: nothing}
    return config.model_copy(update=found)


def scenario_findings(config: ExperimentConfig, known: tuple[str, ...]) -> Iterator[Finding]:
    """Scenarios that nothing says how to play, and settings of such."""
    for index, name in enumerate(config.scenarios):
        if name != NONE and not _is_played(name, config, known):
            yield ("scenarios", index), f"unknown scenario '{name}'; {_what_is_known(name, known)}"
    for name in config.scenario_settings:
        if name not in config.scenarios and not _is_played(name, config, known):
            key = ("scenario_settings", name)
            yield key, f"unknown scenario; {suggestion(name, (*known, *config.scenarios))}"


def _is_played(name: str, config: ExperimentConfig, known: Collection[str]) -> bool:
    """Whether something says what happens in a scenario: its triggers, a script, or chance."""
    scripted = config.settings(name).script is not None
    return scripted or config.has_random_events or name in known


def _what_is_known(name: str, known: Collection[str]) -> str:
    if known:
        return suggestion(name, known)
    return (
        "the domain has no scenarios: with 'scenarios: none' nothing exogenous happens, with "
        "'adversary.strategy: random' events are drawn, and a script may have any name"
    )
