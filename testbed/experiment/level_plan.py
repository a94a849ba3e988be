"""The trials of a configuration's levels: drawn from the root seed, the level and a number."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import msgspec

from testbed.config import ExperimentConfig, grounds, level_size
from testbed.experiment.drawing import Drawing
from testbed.experiment.seeds import generator_of
from testbed.experiment.specs import (
    FineSetting,
    Setting,
    TrialSpec,
    pair_specs,
    setting_of,
)
from testbed.studies.levels.protocol import PROTOCOL


def level_specs(config: ExperimentConfig) -> Iterator[TrialSpec]:
    """The trials in their order: level, number, robot."""
    domain = Path(config.domain).stem
    for level, ground in grounds(config):
        drawing = Drawing(config, ground.refinement)
        texts = [ground.refinement.coarse.text, ground.text] if config.refinement else []
        for number in range(1, (config.limit or 0) + 1):
            place = [level, *texts, number]
            initial, goal = drawing.trial(generator_of(config.seed, place))
            path = [*place, list(initial), sorted(goal)]
            setting = _fine_setting(config, level, goal)
            yield from pair_specs(config, PROTOCOL, level, path, initial, setting, domain)


def _fine_setting(config: ExperimentConfig, level: str, goal: tuple[str, ...]) -> Setting:
    fine = FineSetting(
        size=None if config.refinement else level_size(config, level),
        refinement=config.refinement,
        statistics=dict(sorted(config.statistics.items())),
        pace=config.adversary.pace,
    )
    common = setting_of(config, PROTOCOL)
    return msgspec.structs.replace(common, goal=goal, fine=fine)
