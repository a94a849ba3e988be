"""The messages between a driver and a robot, and the interface of a robot."""

from testbed.protocol.bounds import MOST_BYTES, Count, shortened
from testbed.protocol.capabilities import Capabilities, Knowledge, Resolution
from testbed.protocol.errors import LinkError, RobotGone, RobotLost, RobotStopped, RobotStops
from testbed.protocol.messages import (
    PROTOCOL_VERSION,
    Contradiction,
    Decision,
    Event,
    Explanation,
    FineTrace,
    Message,
    Minimality,
    NoPlan,
    Percept,
    Question,
    Task,
    Trace,
    decode,
    encode,
)
from testbed.protocol.robot import Robot, RobotClient, RobotFactory

__all__ = [
    "MOST_BYTES",
    "PROTOCOL_VERSION",
    "Capabilities",
    "Contradiction",
    "Count",
    "Decision",
    "Event",
    "Explanation",
    "FineTrace",
    "Knowledge",
    "LinkError",
    "Message",
    "Minimality",
    "NoPlan",
    "Percept",
    "Question",
    "Resolution",
    "Robot",
    "RobotClient",
    "RobotFactory",
    "RobotGone",
    "RobotLost",
    "RobotStopped",
    "RobotStops",
    "Task",
    "Trace",
    "decode",
    "encode",
    "shortened",
]
