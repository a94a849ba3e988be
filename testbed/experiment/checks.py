"""Checks of the robots and the adversary that a configuration names."""

from collections.abc import Iterator

from testbed.config import ExperimentConfig, Finding, early_script_findings
from testbed.experiment.adversaries import adversary_findings
from testbed.experiment.robots import HUMAN, ROBOTS
from testbed.protocol import Capabilities
from testbed.registry import RegistryError


def robot_findings(config: ExperimentConfig) -> Iterator[Finding]:
    """Robots that there are not, and those that cannot do what is asked of them."""
    first_action_steps = {}
    for index, name in enumerate(config.robots):
        try:
            able = ROBOTS.find(name).capabilities
        except RegistryError as error:
            yield ("robots", index), str(error)
            continue
        first_action_steps[name] = able.first_action_step
        for lack in _lacks(able, config):
            yield ("robots", index), f"'{name}' {lack}"
    yield from early_script_findings(config, first_action_steps)


def _lacks(able: Capabilities, config: ExperimentConfig) -> Iterator[str]:
    """What a configuration asks for and a robot cannot do."""
    resolution = "fine" if config.is_fine else "coarse"
    if resolution not in able.resolutions:
        others = (n for n, robot in ROBOTS.usable() if resolution in robot.capabilities.resolutions)
        known = ", ".join(others)
        yield f"does not act at the {resolution} resolution; robots that do: {known}"
    if config.knowledge not in able.knowledge:
        kinds = " or ".join(able.knowledge)
        yield f"cannot begin with knowledge: {config.knowledge}; give knowledge: {kinds}"
    if config.plans not in able.plans:
        yield f"does not make plans that are {config.plans}; give plans: {' or '.join(able.plans)}"
    if able.needs_goal_feedback and not config.gives_goal_feedback:
        yield "needs to be told that its goal does not hold; give goal_feedback: true"


def person_findings(config: ExperimentConfig) -> Iterator[Finding]:
    """Agents that a person plays, of whom there is none where trials are run."""
    for index, name in enumerate(config.robots):
        if name == HUMAN:
            yield ("robots", index), f"a person plays '{HUMAN}': testbed play CONFIG --as robot"
    if config.adversary.strategy == HUMAN:
        yield ("adversary", "strategy"), f"a person plays '{HUMAN}': testbed play CONFIG"


CHECKS = (robot_findings, adversary_findings)
"""Checks of what a configuration calls by name, for `load_config`."""
