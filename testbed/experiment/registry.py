"""The robots that can be asked for, by the name that configurations and records give them."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from functools import partial

from agents.intentional import IntentionalRobot
from agents.intentional.checking import CheckingRobot
from agents.intentional.joint import JointLogician
from agents.intentional.logician import Logician
from agents.intentional.undivided import UndividedLogician
from agents.traditional import TraditionalRobot
from agents.traditional.planner import Planner
from asp.spelling import suggestion
from testbed.link.robot import Robot

ROBOTS: Mapping[str, Callable[[], Robot]] = {
    "intentional": IntentionalRobot,
    "intentional-plain": partial(IntentionalRobot, Logician),
    "intentional-joint": partial(IntentionalRobot, JointLogician),
    "intentional-joint-plain": partial(IntentionalRobot, UndividedLogician),
    "intentional-checking": CheckingRobot,
    "traditional": TraditionalRobot,
    "traditional-plain": partial(TraditionalRobot, Planner),
}


def make_robot(kind: str) -> Robot:
    """A new robot of a kind.

    Raises:
        ValueError: for an unknown kind, naming the nearest known one.
    """
    if kind not in ROBOTS:
        raise ValueError(f"unknown robot '{kind}'; {suggestion(kind, ROBOTS)}")
    return ROBOTS[kind]()
