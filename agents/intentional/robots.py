"""The intentional robots that configurations ask for by name, and what each of them can do."""

from __future__ import annotations

from typing import ClassVar

from agents.intentional.checking import CheckingRobot
from agents.intentional.controller import IntentionalRobot
from agents.intentional.joint import JointReasoner
from agents.intentional.joint_reference import JointReferenceReasoner
from agents.intentional.reference import ReferenceReasoner
from agents.intentional.refined import EitherRobot
from testbed.protocol import Capabilities

# At step 1 each of them starts an activity, or finishes.
COARSE = Capabilities(knowledge=("complete", "seen"), first_action_step=2)
FINE = Capabilities(resolutions=("fine",), knowledge=("complete", "seen"), first_action_step=2)
BOTH = Capabilities(
    resolutions=("coarse", "fine"), knowledge=("complete", "seen"), first_action_step=2
)


class Intentional(EitherRobot):
    """ATI at either resolution, zooming at the fine one."""

    capabilities: ClassVar = BOTH


class WithoutZooming(EitherRobot):
    """ATI at the fine resolution, with the whole refined description at each abstract action."""

    capabilities: ClassVar = FINE

    def __init__(self) -> None:
        super().__init__(zooms=False)


class Reference(IntentionalRobot):
    """ATI, each program solved from scratch."""

    capabilities: ClassVar = COARSE

    def __init__(self) -> None:
        super().__init__(ReferenceReasoner)


class Joint(IntentionalRobot):
    """TI: all smallest explanations are considered while planning."""

    capabilities: ClassVar = COARSE

    def __init__(self) -> None:
        super().__init__(JointReasoner)


class JointReference(IntentionalRobot):
    """TI to the letter, in one program."""

    capabilities: ClassVar = COARSE

    def __init__(self) -> None:
        super().__init__(JointReferenceReasoner)


class Checking(CheckingRobot):
    """ATI that looks at what it only assumes before it finishes."""

    capabilities: ClassVar = COARSE
