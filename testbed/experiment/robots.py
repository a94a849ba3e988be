"""The robots that can be asked for, by the name that configurations and records give them."""

from collections.abc import Callable
from typing import Any, Protocol

from testbed.protocol import Capabilities, Robot
from testbed.registry import Registry, class_fault


class RobotClass(Protocol):
    """The class of a robot: it is made without arguments, and says what it can do."""

    capabilities: Capabilities

    def __call__(self) -> Robot: ...


def _fault(found: Any) -> str | None:
    declared = getattr(found, "capabilities", None)
    if isinstance(found, type) and not isinstance(declared, Capabilities):
        return "declares no capabilities; for example: capabilities = Capabilities()"
    snapshots = ("snapshot", "restore") if declared and declared.snapshots else ()
    return class_fault(found, "begin", "act", *snapshots)


HUMAN = "human"
"""The robot, and the adversary, that a person plays."""
ROBOTS: Registry[RobotClass] = Registry(
    "robot",
    "intention_testbed.robots",
    {
        "intentional": "agents.intentional.refined:EitherRobot",
        "intentional-nozoom": "agents.intentional.refined:WithoutZooming",
        "intentional-plain": "agents.intentional.controller:Reference",
        "intentional-joint": "agents.intentional.joint:Joint",
        "intentional-joint-staged": "agents.intentional.joint:StagedJoint",
        "intentional-checking": "agents.intentional.checking:CheckingRobot",
        "traditional": "agents.traditional.robot:TraditionalRobot",
        "traditional-plain": "agents.traditional.robot:TraditionalReference",
        HUMAN: "agents.human:Human",
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
