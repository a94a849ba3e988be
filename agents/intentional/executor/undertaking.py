"""An abstract action in progress, which can be gone on with in several ways."""

from __future__ import annotations

from collections.abc import Sequence
from copy import copy

from agents.intentional.abstraction import AbstractTask
from agents.intentional.executor.belief import FineTracker
from agents.intentional.executor.execution import Execution
from agents.intentional.executor.sensing import Asking
from asp.language import Action
from asp.solving import State
from testbed.protocol import Percept


class Undertaking:
    """The execution of one abstract action, percept by percept.

    The course of an execution cannot be copied. A copy begins it anew when it is asked for more,
    with the tracker as it was then, and hears the same percepts; the plans that were found are
    known. `execution` is to be read when the undertaking `is_over`.
    """

    def __init__(
        self, fine: FineTracker, coarse: AbstractTask, action: Action, before: State, step: int
    ) -> None:
        """`before` is the coarse state that the action is to lead from."""
        self._fine = fine
        self.execution = Execution(fine, coarse, action, before, step)
        self._at_first = fine.copy()
        self._heard: Sequence[Percept] = ()
        self._course: Asking[None] | None = self.execution.run()
        self.is_over = False

    def first(self) -> Action | None:
        """The first concrete action; None where nothing needs to be done."""
        assert self._course is not None
        return self._ended(next(self._course, None))

    def next(self, percept: Percept) -> Action | None:
        """The concrete action after a percept; None: it is over."""
        course = self._course or self._begun_anew()
        self._heard = (*self._heard, percept)
        try:
            return course.send(percept)
        except StopIteration:
            return self._ended(None)

    def copy(self, fine: FineTracker) -> Undertaking:
        """One that has come as far, with a copy of the tracker."""
        other = copy(self)
        other._fine, other._course = fine, None
        if not self.is_over:
            other.execution = self.execution.anew(fine)
        return other

    def _begun_anew(self) -> Asking[None]:
        trace = self._fine.trace
        self._fine.become(self._at_first)
        course = self._course = self.execution.run()
        next(course)
        for percept in self._heard:
            course.send(percept)
        self._fine.trace = trace
        return course

    def _ended(self, action: Action | None) -> Action | None:
        self.is_over = action is None
        return action
