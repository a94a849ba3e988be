"""The robots that can be asked for, by the name that configurations and records give them."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from functools import partial

from agents.intentional import IntentionalRobot
from agents.intentional.checking import CheckingRobot
from agents.intentional.joint import JointLogician
from agents.intentional.joint_reference import UndividedLogician
from agents.intentional.reference import Logician
from agents.intentional.refined import EitherRobot
from agents.traditional import TraditionalRobot
from agents.traditional.reference import Planner
from asp.language import suggestion
from testbed.protocol import Robot

ROBOTS: Mapping[str, Callable[[], Robot]] = {
    "intentional": EitherRobot,
    "intentional-nozoom": partial(EitherRobot, zooms=False),
    "intentional-plain": partial(IntentionalRobot, Logician),
    "intentional-joint": partial(IntentionalRobot, JointLogician),
    "intentional-joint-plain": partial(IntentionalRobot, UndividedLogician),
    "intentional-checking": CheckingRobot,
    "traditional": TraditionalRobot,
    "traditional-plain": partial(TraditionalRobot, Planner),
}

FINE = ("intentional", "intentional-nozoom")
"""Those that can act at the fine resolution."""
ONLY_FINE = ("intentional-nozoom",)
"""Those that act there alone."""
STARTERS = tuple(name for name in ROBOTS if name.startswith("intentional"))
"""Those that at step 1 start an activity, or finish: they act on the world from step 2 on."""


def known_robots(fine: bool) -> tuple[str, ...]:
    """The names of the robots that can act at the fine, or at the coarse resolution."""
    return FINE if fine else tuple(name for name in ROBOTS if name not in ONLY_FINE)


def make_robot(kind: str) -> Robot:
    """A new robot of a kind.

    Raises:
        ValueError: for an unknown kind, naming the nearest known one.
    """
    if kind not in ROBOTS:
        raise ValueError(f"unknown robot '{kind}'; {suggestion(kind, ROBOTS)}")
    return ROBOTS[kind]()
