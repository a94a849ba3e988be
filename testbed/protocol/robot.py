"""The two sides of the link: a robot with its capabilities, and its client at the driver."""

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any, Literal, Protocol, TypeAlias, get_args, runtime_checkable

from testbed.protocol.messages import Decision, Percept, Plans, Task

Resolution: TypeAlias = Literal["coarse", "fine"]
Knowledge: TypeAlias = Literal["complete", "seen"]


@dataclass(frozen=True, kw_only=True)
class Capabilities:
    """What a robot can do, declared as the attribute ``capabilities`` of its class.

    ``resolutions`` are those at which it acts: ``coarse``, and ``fine`` where its task can have a
    refinement. ``knowledge`` are the kinds of knowledge of the initial state that it can begin
    with: ``complete``, and ``seen`` where ``Task.initial`` may leave fluents open.
    ``needs_goal_feedback``: it relies on being told, by ``Percept.goal_holds``, that it finished
    without its goal. ``plans`` are the kinds of plans that it can be asked for (``Task.plans``).
    ``first_action_step`` is the first step at which it may attempt a physical
    action; a robot that starts an activity by a mental action has 2. ``snapshots``: it is a
    :class:`Restorable`.

    Raises ValueError for a resolution, or a kind of knowledge or plans, that there is not.
    """

    resolutions: tuple[Resolution, ...] = ("coarse",)
    knowledge: tuple[Knowledge, ...] = ("complete",)
    needs_goal_feedback: bool = False
    plans: tuple[Plans, ...] = ("optimistic",)
    first_action_step: int = 1
    snapshots: bool = False

    def __post_init__(self) -> None:
        known = {
            "resolutions": get_args(Resolution),
            "knowledge": get_args(Knowledge),
            "plans": get_args(Plans),
        }
        for name, choices in known.items():
            given = getattr(self, name)
            if isinstance(given, str) or not set(given) <= set(choices):
                raise ValueError(f"{name}: {given!r} should be some of {', '.join(choices)}")


class Robot(Protocol):
    """An agent that acts for the length of one trial."""

    def begin(self, task: Task) -> None:
        """Take on the task; called once, before the first percept."""

    def act(self, percept: Percept) -> Decision:
        """Decide what to attempt at ``percept.step``; the decision repeats its trial and step."""


@runtime_checkable
class Restorable(Robot, Protocol):
    """A robot that can go back to where it was, so that a search need not begin again.

    From there on it decides as it would have done, whatever was done with it in between.
    """

    def snapshot(self) -> Any:
        """All that its decisions depend on from now on; nothing changes it. After `begin`."""

    def restore(self, snapshot: Any) -> None:
        """Goes back to a snapshot, its own or of another robot of its class in this process.

        The snapshot may be used again.
        """


RobotFactory: TypeAlias = Callable[[str], Robot]
"""Makes a new robot of a kind (``Task.robot``), or raises an error that names the known ones."""


class RobotClient(Protocol):
    """A driver's end of the link, the same wherever the robot runs."""

    def begin(self, task: Task) -> None:
        """Prepare a trial; the task goes out with its first percept. Raises RobotLost."""

    def ask(self, percept: Percept) -> Decision:
        """Return the robot's decision. Raises RobotLost: then the trial is over, and the
        next may begin."""

    def close(self) -> None:
        """Let go of the robot; nothing is asked afterwards."""
