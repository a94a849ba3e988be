"""Variants of the intentional robot that configurations ask for by name."""

from typing import ClassVar

from agents.intentional.controller import IntentionalRobot
from agents.intentional.joint import JointReasoner, JointReferenceReasoner
from agents.intentional.reasoners import ReferenceReasoner
from agents.intentional.refined import EitherRobot
from testbed.protocol import Capabilities


class WithoutZooming(EitherRobot):
    """ATI at the fine resolution, with the whole refined description at each abstract action."""

    capabilities: ClassVar = Capabilities(
        resolutions=("fine",), knowledge=("complete", "seen"), first_action_step=2
    )

    def __init__(self) -> None:
        super().__init__(zooms=False)


class Reference(IntentionalRobot):
    """ATI, each program solved from scratch."""

    def __init__(self) -> None:
        super().__init__(ReferenceReasoner)


class Joint(IntentionalRobot):
    """TI: all smallest explanations are considered while planning."""

    def __init__(self) -> None:
        super().__init__(JointReasoner)


class JointReference(IntentionalRobot):
    """TI to the letter, in one program."""

    def __init__(self) -> None:
        super().__init__(JointReferenceReasoner)
