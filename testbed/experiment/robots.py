"""The robots that can be asked for, by the name that configurations and records give them."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from typing import Any, Protocol

from testbed.config import ExperimentConfig, Finding, early_script_findings
from testbed.protocol import Capabilities, Robot
from testbed.registry import Registry, RegistryError, class_fault

_INTENTIONAL, _TRADITIONAL = "agents.intentional", "agents.traditional.robot"


class RobotClass(Protocol):
    """The class of a robot: it is made without arguments, and says what it can do."""

    capabilities: Capabilities

    def __call__(self) -> Robot: ...


def _fault(found: Any) -> str | None:
    if not isinstance(getattr(found, "capabilities", None), Capabilities) and isinstance(
        found, type
    ):
        return "declares no capabilities; for example: capabilities = Capabilities()"
    return class_fault(found, "begin", "act")


ROBOTS: Registry[RobotClass] = Registry(
    "robot",
    "intention_testbed.robots",
    {
        "intentional": f"{_INTENTIONAL}.refined:EitherRobot",
        "intentional-nozoom": f"{_INTENTIONAL}.robots:WithoutZooming",
        "intentional-plain": f"{_INTENTIONAL}.robots:Reference",
        "intentional-joint": f"{_INTENTIONAL}.robots:Joint",
        "intentional-joint-plain": f"{_INTENTIONAL}.robots:JointReference",
        "intentional-checking": f"{_INTENTIONAL}.checking:CheckingRobot",
        "traditional": f"{_TRADITIONAL}:TraditionalRobot",
        "traditional-plain": f"{_TRADITIONAL}:TraditionalReference",
    },
    _fault,
)


def make_robot(name: str) -> Robot:
    """A new robot. Raises RegistryError as `Registry.find` does."""
    return ROBOTS.find(name)()


def only(name: str) -> Callable[[str], Robot]:
    """As `make_robot`, of one robot alone: another one is refused. Raises RegistryError."""
    robot = ROBOTS.find(name)

    def make(asked: str) -> Robot:
        if asked != name:
            raise ValueError(f"this process serves '{name}', and was asked for '{asked}'")
        return robot()

    return make


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
    if able.needs_goal_feedback and not config.gives_goal_feedback:
        yield "needs to be told that its goal does not hold; give goal_feedback: true"
