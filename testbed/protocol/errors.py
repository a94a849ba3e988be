"""Errors between a driver and its robot."""

from testbed.protocol.bounds import shortened

NOT_UNDERSTOOD = "answer not understood"
"""How the reason begins where a robot is lost for the form of what it said."""


class LinkError(ValueError):
    """A message that cannot be understood: wrong version, wrong form, or not MessagePack at all."""


class RobotLost(Exception):  # noqa: N818 - an outcome of a trial, by the name records give it
    """The robot will not answer this trial any more.

    ``reason`` is one line that says why, the same whenever the same happens; ``details`` is the
    robot's traceback, or whatever its process wrote to its standard error, if anything.
    """

    def __init__(self, reason: str, details: str = "") -> None:
        super().__init__(reason)
        self.reason = reason
        self.details = details


class RobotStops(Exception):  # noqa: N818 - what a robot does, not what went wrong with it
    """A robot's own reason, in one line, not to go on with a trial; it can begin another one."""


class RobotStopped(RobotLost):
    """The robot did not want to go on with the trial, for its ``reason``; it is not lost itself."""


class RobotGone(RobotLost):
    """The robot is not there any more, or was never there: its process ended, or the link did."""


def in_one_line(error: BaseException) -> str:
    """Return what an exception says: of a robot's, what travels to the driver."""
    try:
        said = str(error)
    except Exception:  # of the exception's own making
        said = "its text cannot be had"
    writable = said.encode(errors="backslashreplace").decode()  # names of files need not be Unicode
    return shortened(" ".join(f"{type(error).__name__}: {writable}".split()))
