"""What the adversary may do beside the robot's action, asked for one event or for all."""

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Any

from asp.language import Action, Fluent, Literal
from testbed.environment.execution import Execution
from testbed.protocol import FINISH, NONE, WAIT


@dataclass(frozen=True)
class Legality:
    """An event is legal where it is possible however the robot's action comes out.

    The robot's action may not be known (None). `while_thinking`: waiting lets others act.
    """

    execution: Execution
    while_thinking: bool

    def allows(self, state: int, robot_action: Action | None, event: Action) -> bool:
        """Whether the event is legal; doing nothing always is."""
        if event == NONE:
            return True
        if self._closed(state, robot_action) is not None:
            return False
        executable, ways = self.execution.world.executable, self._ways(state, robot_action)
        return all(executable(state, (*way, event)) for way in ways)

    def why_not(self, state: int, robot_action: Action | None, event: Action) -> str | None:
        """One line that says why the event is not legal; None if it is."""
        if event == NONE:
            return None
        why_not, ways = self.execution.world.why_not, self._ways(state, robot_action)
        reasons = (why_not(state, (*way, event)) for way in ways)
        return self._closed(state, robot_action) or next(filter(None, reasons), None)

    def possible(self, state: int, robot_action: Action) -> bool:
        """Whether the robot attempts something, and not in vain."""
        idle = robot_action in (WAIT, FINISH)
        return not idle and self.execution.possible(state, robot_action)

    def _closed(self, state: int, robot_action: Action | None) -> str | None:
        """Why nothing exogenous happens beside the robot's action, if so."""
        if robot_action is None:
            return None
        if robot_action == FINISH:
            return "nothing exogenous happens while the robot finishes"
        if robot_action == WAIT:
            closed = "nothing exogenous happens while the robot waits (exogenous_while_thinking)"
            return None if self.while_thinking else closed
        return self.execution.closed_to_events(state, robot_action)

    def _ways(self, state: int, robot_action: Action | None) -> Iterator[tuple[Action, ...]]:
        """The robot's part of the compound action, in each way in which it may come out."""
        if robot_action is None or not self.possible(state, robot_action):
            yield ()
            return
        yield self.execution.physical(robot_action)
        if self.execution.chance(robot_action) < 1:
            yield ()


class LegalEvents(Sequence[Action]):
    """The candidates that pass a test, in their order; `in` tests one, iterating tests on.

    The number of them tests each, and is not asked for a second time by who then iterates.
    """

    def __init__(self, candidates: Sequence[Fluent], legal: Callable[[Action], bool]) -> None:
        self._candidates = candidates
        self._legal = legal

    @cached_property
    def _all(self) -> tuple[Action, ...]:
        return tuple(filter(self._legal, self._candidates))

    def __contains__(self, event: object) -> bool:
        return isinstance(event, Literal) and event in self._candidates and self._legal(event)

    def __iter__(self) -> Iterator[Action]:
        # `tuple` asks for an iterator, then for the number, and only then for the first item.
        yield from self._all if "_all" in vars(self) else filter(self._legal, self._candidates)

    def __len__(self) -> int:
        return len(self._all)

    def __getitem__(self, index: Any) -> Any:
        return self._all[index]
