"""The robots that can be asked for, by the name that configurations and records give them."""

from collections.abc import Callable
from typing import Any, Protocol

from testbed.protocol import Capabilities, Robot
from testbed.registry import Registry, class_fault

_INTENTIONAL, _TRADITIONAL = "agents.intentional", "agents.traditional.robot"


class RobotClass(Protocol):
    """The class of a robot: it is made without arguments, and says what it can do."""

    capabilities: Capabilities

    def __call__(self) -> Robot: ...


def _fault(found: Any) -> str | None:
    declared = getattr(found, "capabilities", None)
    if isinstance(found, type) and not isinstance(declared, Capabilities):
        return "declares no capabilities; for example: capabilities = Capabilities()"
    return class_fault(found, "begin", "act")


ROBOTS: Registry[RobotClass] = Registry(
    "robot",
    "intention_testbed.robots",
    {
        "intentional": f"{_INTENTIONAL}.refined:EitherRobot",
        "intentional-nozoom": f"{_INTENTIONAL}.refined:WithoutZooming",
        "intentional-plain": f"{_INTENTIONAL}.controller:Reference",
        "intentional-joint": f"{_INTENTIONAL}.joint:Joint",
        "intentional-joint-plain": f"{_INTENTIONAL}.joint:JointReference",
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
