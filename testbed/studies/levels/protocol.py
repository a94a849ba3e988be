"""The published experiment with the levels, as a configuration names it."""

from __future__ import annotations

from testbed.analysis.condition import deviations
from testbed.config import ExperimentConfig
from testbed.studies.levels.published import OWN, PAPER, Paper

PROTOCOL = "levels"
"""Also what stands in place of a scenario in records of trials at the fine resolution."""


def paper_of(config: ExperimentConfig) -> Paper:
    """What a run is to be compared with: the published figures, if it is played as these were."""
    return PAPER if config.protocol == PROTOCOL and not deviations(config, PROTOCOL) else OWN
