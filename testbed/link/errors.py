"""What can go wrong between a driver and its robot."""


class LinkError(ValueError):
    """A message that cannot be understood: wrong version, wrong form, or not MessagePack at all."""


class RobotLost(Exception):
    """The robot will not answer this trial any more; ``reason`` is one line that says why."""

    def __init__(self, reason: str) -> None:
        super().__init__(reason)
        self.reason = reason
