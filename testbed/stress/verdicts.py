"""What an objective says of an episode."""

from dataclasses import dataclass

import msgspec

from testbed.protocol import shortened
from testbed.text import plain


class Finding(msgspec.Struct, frozen=True, order=True):
    """What an objective found in an episode: the `rule` that is broken, where, and in words.

    `step` is None where it is about the whole episode. `amount` is what was measured, in the
    objective's unit; None where nothing is.
    """

    objective: str
    rule: str
    step: int | None
    detail: str
    amount: float | None = None


def in_a_line(text: str) -> str:
    """Text, also of a robot, as a file and a screen may have it: a line of bounded length."""
    written = text.encode(errors="backslashreplace").decode()
    return shortened(plain(" ".join(written.split())))


@dataclass(frozen=True)
class Verdict:
    """How near an episode is to a finding, and what was found."""

    score: float = 0.0
    findings: tuple[Finding, ...] = ()
