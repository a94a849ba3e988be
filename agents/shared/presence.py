"""Who is there to ask, where a person plays an agent."""

from collections.abc import Iterator
from contextlib import contextmanager
from contextvars import ContextVar
from typing import Generic, TypeVar

from asp.language import Action
from testbed.protocol import FINISH, Decision, Percept, Trace

Ask = TypeVar("Ask")


class Presence(Generic[Ask]):
    """A person who is present within a block, in the thread of that block."""

    def __init__(self, name: str) -> None:
        self._ask: ContextVar[Ask | None] = ContextVar(name, default=None)

    @contextmanager
    def of(self, ask: Ask) -> Iterator[None]:
        """Let a person be asked in this block."""
        token = self._ask.set(ask)
        try:
            yield
        finally:
            self._ask.reset(token)

    @property
    def ask(self) -> Ask | None:
        """What asks the person; None where nobody is there."""
        return self._ask.get()


def answered(percept: Percept, action: Action) -> Decision:
    """The decision of somebody who tells nothing of a mind."""
    return Decision(
        trial=percept.trial,
        step=percept.step,
        action=action,
        believes_goal=action == FINISH,
        trace=Trace(),
    )
