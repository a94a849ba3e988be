"""The lines of a refusal: one a finding, and one for all that was written for another domain."""

from __future__ import annotations

from collections.abc import Sequence

from testbed.config.models import ExperimentConfig
from testbed.config.places import Places, dotted
from testbed.config.words import Finding

OF_THE_DOMAIN = ("goal", "initial", "scenarios", "scenario_settings", "script", "observability")
"""What is said in the words of a domain."""


def lines_of(findings: Sequence[Finding], places: Places) -> list[str]:
    return [f"{places.of(key)}: {message}" for key, message in findings]


def lines_of_the_domain(
    config: ExperimentConfig, findings: list[Finding], places: Places
) -> list[str]:
    """Lines of what the domain does not know; one for all that was written for another domain."""
    strange = any(not places.is_overridden(key) for key, _ in findings)
    if not (strange and places.is_overridden(("domain",))):
        return lines_of(findings, places)
    # What would fit this domain by chance is named, too: it was not meant for it.
    written = [key for key in OF_THE_DOMAIN if getattr(config, key)]
    foreign = [key for key in written if not places.is_overridden((key,))]
    return _of_another("domain", foreign, findings, places)


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
