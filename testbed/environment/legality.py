"""What the adversary may do beside the robot's action, asked for one event or for all."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import overload

from testbed.environment.execution import Execution
from testbed.world import World

WAIT, FINISH, NONE = "wait", "finish", "none"
"""The actions that are the environment's own: of the robot, and of the adversary."""


@dataclass(frozen=True)
class Moment:
    """A state, the robot's action in it (None: not known), and whether waiting lets others act."""

    state: int
    robot_action: str | None
    opens_thinking: bool


@dataclass(frozen=True)
class Legality:
    """An event is legal where it is possible however the robot's action comes out."""

    world: World
    execution: Execution

    def allows(self, moment: Moment, event: str) -> bool:
        """Whether the event is legal; doing nothing always is."""
        if event == NONE:
            return True
        if self.closed(moment) is not None:
            return False
        executable = self.world.executable
        return all(executable(moment.state, (*way, event)) for way in self._ways(moment))

    def why_not(self, moment: Moment, event: str) -> str | None:
        """One line that says why the event is not legal; None if it is."""
        if event == NONE:
            return None
        why_not = self.world.why_not
        reasons = (why_not(moment.state, (*way, event)) for way in self._ways(moment))
        return self.closed(moment) or next(filter(None, reasons), None)

    def closed(self, moment: Moment) -> str | None:
        """Why nothing exogenous happens beside the robot's action, if so."""
        if moment.robot_action is None:
            return None
        if moment.robot_action == FINISH:
            return "nothing exogenous happens while the robot finishes"
        if moment.robot_action == WAIT:
            closed = "nothing exogenous happens while the robot waits (exogenous_while_thinking)"
            return None if moment.opens_thinking else closed
        return self.execution.closed_to_events(moment.state, moment.robot_action)

    def possible(self, moment: Moment) -> bool:
        """Whether the robot attempts something, and not in vain."""
        if moment.robot_action in (None, WAIT, FINISH):
            return False
        return self.execution.possible(moment.state, str(moment.robot_action))

    def _ways(self, moment: Moment) -> Iterator[tuple[str, ...]]:
        """The robot's part of the compound action, in each way in which it may come out."""
        if not self.possible(moment):
            yield ()
            return
        action = str(moment.robot_action)
        yield self.execution.physical(action)
        if self.execution.chance(action) < 1:
            yield ()


class LegalEvents(Sequence[str]):
    """The candidates that pass a test, in their order; `in` tests one, iterating tests on.

    The number of them tests each, and is not asked for a second time by who then iterates.
    """

    def __init__(self, candidates: Sequence[str], legal: Callable[[str], bool]) -> None:
        self._candidates = candidates
        self._legal = legal

    @cached_property
    def _all(self) -> tuple[str, ...]:
        return tuple(filter(self._legal, self._candidates))

    def __contains__(self, event: object) -> bool:
        return event in self._candidates and self._legal(str(event))

    def __iter__(self) -> Iterator[str]:
        # `tuple` asks for an iterator, then for the number, and only then for the first item.
        yield from self._all if "_all" in vars(self) else filter(self._legal, self._candidates)

    def __len__(self) -> int:
        return len(self._all)

    @overload
    def __getitem__(self, index: int) -> str: ...
    @overload
    def __getitem__(self, index: slice) -> Sequence[str]: ...
    def __getitem__(self, index: int | slice) -> str | Sequence[str]:
        return self._all[index]
