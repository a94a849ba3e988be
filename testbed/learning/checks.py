"""Checks of who plays inside of one side of a game, before a game begins."""

from collections.abc import Callable

from testbed.config import ConfigError, ExperimentConfig, dotted
from testbed.experiment.adversaries import AdversaryError, adversary_findings
from testbed.experiment.checks import person_findings, robot_findings
from testbed.learning.table_robots import CHEAPEST


def check_robot(config: ExperimentConfig, robot: object) -> None:
    """Raises ConfigError for a robot that there is not, or that cannot play here by itself."""
    if not isinstance(robot, str):
        raise ConfigError([f"keyword argument: robot: should be a name, not {robot!r}"])
    asked = config.model_copy(update={"robots": (robot,)})
    found = (*robot_findings(asked), *person_findings(asked))
    if lines := [why for key, why in found if key[0] == "robots"]:
        of_tables = f"; of table robots there is '{CHEAPEST}'"
        raise ConfigError([f"keyword argument: robot: {why}{of_tables}" for why in lines])


def check_adversary(config: ExperimentConfig, make: Callable[[], object]) -> None:
    """Raises ConfigError for a strategy, or options, of which `make` makes no adversary."""
    found = (*adversary_findings(config), *person_findings(config))
    if lines := [f"{dotted(key)}: {why}" for key, why in found if key[0] == "adversary"]:
        raise ConfigError([f"{config.name}: {line}" for line in lines])
    try:
        make()
    except AdversaryError as error:
        raise ConfigError([f"{config.name}: adversary: {error}"]) from error
