"""The traditional robots that configurations ask for by name, and what each of them can do."""

from __future__ import annotations

from typing import ClassVar

from agents.traditional.reference import ReferenceReasoner
from agents.traditional.robot import TraditionalRobot
from testbed.protocol import Capabilities

COARSE = Capabilities(knowledge=("complete", "seen"))


class Traditional(TraditionalRobot):
    """TP on grounded programs that are reused."""

    capabilities: ClassVar = COARSE


class TraditionalReference(TraditionalRobot):
    """TP, each program solved from scratch."""

    capabilities: ClassVar = COARSE

    def __init__(self) -> None:
        super().__init__(ReferenceReasoner)
