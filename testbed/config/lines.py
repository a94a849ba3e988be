"""The lines of a refusal: one a finding, and one for all that was written for another domain."""

from __future__ import annotations

from collections.abc import Sequence

from testbed.config.models import NONE, ExperimentConfig
from testbed.config.places import Key, Places, dotted
from testbed.config.words import Finding

OF_THE_DOMAIN = ("goal", "initial", "scenarios", "scenario_settings", "script", "observability")
"""What is said in the words of a domain."""


def lines_of(findings: Sequence[Finding], places: Places) -> list[str]:
    return [f"{places.of(key)}: {message}" for key, message in findings]


def without_left_out(findings: Sequence[Finding], places: Places) -> list[Finding]:
    """Without unknown scenarios that have settings in the file, where `scenarios` is overridden."""
    if not places.is_overridden(("scenarios",)):
        return list(findings)

    def is_left_out(key: Key) -> bool:
        return key[0] == "scenario_settings" and len(key) == 2 and not places.is_overridden(key)

    return [(key, message) for key, message in findings if not is_left_out(key)]


def lines_of_the_domain(
    config: ExperimentConfig, findings: list[Finding], places: Places, scenarios: Sequence[str]
) -> list[str]:
    """Lines of what the domain does not know; one for all that was written for another domain.

    `scenarios` are those of the domain.
    """
    strange = any(not places.is_overridden(key) for key, _ in findings)
    if not (strange and places.is_overridden(("domain",))):
        return lines_of(findings, places)
    # What would fit this domain by chance is named, too: it was not meant for it.
    written = [key for key in OF_THE_DOMAIN if _is_written(key, config)]
    foreign = {key: key for key in written if not places.is_overridden((key,))}
    if "scenarios" in foreign and not scenarios:
        foreign["scenarios"] += f" (it has none: {NONE})"
    return _of_another("domain", [*foreign.values()], findings, places)


def _is_written(key: str, config: ExperimentConfig) -> bool:
    """Whether the configuration says something; settings of a scenario left out say nothing."""
    if key == "scenario_settings" and config.scenarios:
        return not config.scenario_settings.keys().isdisjoint(config.scenarios)
    return bool(getattr(config, key))


def lines_of_the_map(findings: list[Finding], places: Places) -> list[str]:
    """Lines of what a map does not know; one for all that was written for other levels."""
    foreign = {
        dotted(key[:2]) if key[0] == "draw" else str(key[0]): message.partition(";")[0]
        for key, message in reversed(findings)
        if not places.is_overridden(key)
    }
    if not (foreign and places.is_overridden(("refinement",))):
        return lines_of(findings, places)
    wanted = [f"{key} ({message})" for key, message in reversed(foreign.items())]
    return _of_another("refinement", wanted, findings, places)


def _of_another(
    key: str, foreign: Sequence[str], findings: list[Finding], places: Places
) -> list[str]:
    own = [(key, message) for key, message in findings if places.is_overridden(key)]
    wanted = f"{places.file} is about another domain; with this one give also {', '.join(foreign)}"
    return [f"{places.of((key,))}: {wanted}", *lines_of(own, places)]
