"""A robot behind zenoh, seen from its driver."""

from contextlib import suppress
from dataclasses import dataclass
from math import ceil
from queue import Empty, SimpleQueue
from threading import Event
from typing import TypeAlias

import zenoh

from testbed.link import keys
from testbed.link.exchange import Client, failed
from testbed.link.session import LEASE_S
from testbed.protocol import RobotGone, RobotLost, Task

PRESENCE_S = 10.0
_PIECE_S = 1.0
_LEFT = "robot is gone"

_Inbox: TypeAlias = SimpleQueue[zenoh.Reply | RobotLost]


@dataclass(eq=False)
class RemoteRobot(Client):
    """A client of the robot that serves under ``name`` where ``session`` can reach it.

    A question ends with whatever comes first: the answer, the loss of the robot's liveliness
    token, the end of the query without an answer (nobody there), or the answer limit in seconds.
    """

    session: zenoh.Session
    run: str
    name: str
    answer_s: float

    def __post_init__(self) -> None:
        self._present = Event()
        self._inbox: _Inbox = SimpleQueue()
        liveliness, key = self.session.liveliness(), keys.robot(self.name)
        self._watch = liveliness.declare_subscriber(key, self._on_presence, history=True)

    def wait(self, seconds: float) -> bool:
        """Wait until the robot is there, at most so long; return whether it is."""
        return self._present.wait(seconds)

    def begin(self, task: Task) -> None:
        """Prepare a trial. Raises RobotLost when the robot is not there."""
        if not self.wait(PRESENCE_S):
            raise RobotGone("robot is not there")
        super().begin(task)

    def close(self) -> None:
        """Stop watching the robot, which itself serves on."""
        self._watch.undeclare()  # type: ignore[no-untyped-call]

    def _answer(self, trial: str, question: bytes) -> bytes:
        inbox = self._inbox = SimpleQueue()
        if not self._present.is_set():
            raise RobotGone(_LEFT)
        unanswered = RobotGone("robot is unavailable: nobody answered")
        self.session.get(
            keys.question(self.run, trial, self.name),
            zenoh.handlers.Callback(inbox.put, lambda: inbox.put(unanswered)),
            # Every robot hears the question and one answers; the others may be busy meanwhile.
            target=zenoh.QueryTarget.ALL,
            consolidation=zenoh.ConsolidationMode.NONE,
            payload=question,
            # Later than our own limit: zenoh's timeout would look like an error of the robot's,
            # and it counts the time in which this process is paused.
            timeout=self.answer_s + LEASE_S,
        )
        try:
            received = _next(inbox, self.answer_s)
        except Empty:
            raise RobotLost(f"no answer within {self.answer_s:g} s") from None
        if isinstance(received, RobotLost):
            raise received
        if received.err is not None:
            raise failed(bytes(received.err.payload).decode(errors="replace"))
        assert received.ok is not None
        return bytes(received.ok.payload)

    def _on_presence(self, sample: zenoh.Sample) -> None:
        if sample.kind == zenoh.SampleKind.PUT:
            self._present.set()
        else:
            self._present.clear()
            self._inbox.put(RobotGone(_LEFT))


def _next(inbox: _Inbox, seconds: float) -> zenoh.Reply | RobotLost:
    """What comes within so many seconds; of a pause of this process one piece counts at most.

    Raises Empty.
    """
    pieces = max(1, ceil(seconds / _PIECE_S))
    for _ in range(pieces):
        with suppress(Empty):
            return inbox.get(timeout=seconds / pieces)
    raise Empty
