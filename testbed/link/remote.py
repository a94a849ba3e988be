"""A robot behind zenoh, seen from its driver."""

from contextlib import ExitStack, suppress
from math import ceil
from queue import Empty, SimpleQueue
from threading import Event
from typing import TypeAlias

import zenoh

from testbed.link import keys
from testbed.link.exchange import failed, read_decision
from testbed.link.session import LEASE_S
from testbed.protocol import Decision, Percept, Question, RobotGone, RobotLost, Task, encode

PRESENCE_S = 10.0
_PIECE_S = 1.0
_LEFT = "robot is gone"

_Inbox: TypeAlias = SimpleQueue[zenoh.Reply | RobotLost]


class RemoteRobot:
    """A RobotClient for the robot that serves under ``name`` where ``session`` can reach it.

    A question ends with whatever comes first: the answer, the loss of the robot's liveliness
    token, the end of the query without an answer (nobody there), or the answer limit in seconds.
    """

    def __init__(self, session: zenoh.Session, run: str, name: str, answer_s: float) -> None:
        self._session = session
        self._run = run
        self._name = name
        self._answer_s = answer_s
        self._task: Task | None = None
        self._present = Event()
        self._inbox: _Inbox = SimpleQueue()
        self._watch = ExitStack()
        self._watch.enter_context(
            session.liveliness().declare_subscriber(
                keys.robot(name), self._on_presence, history=True
            )
        )

    def wait(self, seconds: float) -> bool:
        """Wait until the robot is there, at most so long; return whether it is."""
        return self._present.wait(seconds)

    def begin(self, task: Task) -> None:
        """Prepare a trial. Raises RobotLost when the robot is not there."""
        if not self.wait(PRESENCE_S):
            raise RobotGone("robot is not there")
        self._task = task

    def ask(self, percept: Percept) -> Decision:
        """Return the robot's decision. Raises RobotLost."""
        question = encode(Question(percept=percept, task=self._task))
        self._task = None
        return read_decision(self._first_answer(percept.trial, question), percept)

    def close(self) -> None:
        """Stop watching the robot, which itself serves on."""
        self._watch.close()

    def _first_answer(self, trial: str, question: bytes) -> bytes:
        inbox = self._inbox = SimpleQueue()
        if not self._present.is_set():
            raise RobotGone(_LEFT)
        self._send(trial, question, inbox)
        try:
            return _payload(_next(inbox, self._answer_s))
        except Empty:
            raise RobotLost(f"no answer within {self._answer_s:g} s") from None

    def _send(self, trial: str, question: bytes, inbox: _Inbox) -> None:
        def ended() -> None:
            inbox.put(RobotGone("robot is unavailable: nobody answered"))

        self._session.get(
            keys.question(self._run, trial, self._name),
            zenoh.handlers.Callback(inbox.put, ended),
            # Every robot hears the question and one answers; the others may be busy meanwhile.
            target=zenoh.QueryTarget.ALL,
            consolidation=zenoh.ConsolidationMode.NONE,
            payload=question,
            # Later than our own limit: zenoh's timeout would look like an error of the robot's,
            # and it counts the time in which this process is paused.
            timeout=self._answer_s + LEASE_S,
        )

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


def _payload(received: zenoh.Reply | RobotLost) -> bytes:
    if isinstance(received, RobotLost):
        raise received
    if received.err is not None:
        raise failed(bytes(received.err.payload).decode(errors="replace"))
    assert received.ok is not None
    return bytes(received.ok.payload)
