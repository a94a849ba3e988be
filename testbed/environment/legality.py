"""Legal exogenous actions beside the robot's action, asked for one event or for all."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Any

from asp.language import Action, Literal
from testbed.environment.execution import Execution
from testbed.protocol import FINISH, NONE, WAIT


@dataclass(eq=False)
class LegalEvents(Sequence[Action]):
    """The adversary's actions that are legal beside the robot's in a state, in their order.

    An event is legal where it is possible however the robot's action comes out; doing nothing
    always is. The robot's action may not be known (None). `while_thinking`: waiting lets others
    act. `in` tests one event, iterating tests on. The number of them tests each, and is not asked
    for a second time by who then iterates.
    """

    execution: Execution
    while_thinking: bool
    candidates: Sequence[Action]
    state: int
    robot_action: Action | None

    def allows(self, event: Action) -> bool:
        """Whether one of the candidates is legal."""
        if event == NONE:
            return True
        executable = self.execution.world.executable
        return self._closed is None and all(executable(self.state, (*w, event)) for w in self._ways)

    def why_not(self, event: Action) -> str | None:
        """One line that says why the event is not legal; None if it is."""
        if event == NONE:
            return None
        why_not = self.execution.world.why_not
        reasons = (why_not(self.state, (*way, event)) for way in self._ways)
        return self._closed or next(filter(None, reasons), None)

    @cached_property
    def _closed(self) -> str | None:
        """Why nothing exogenous happens beside the robot's action, if so."""
        if self.robot_action is None:
            return None
        if self.robot_action == FINISH:
            return "nothing exogenous happens while the robot finishes"
        if self.robot_action == WAIT:
            closed = "nothing exogenous happens while the robot waits (exogenous_while_thinking)"
            return None if self.while_thinking else closed
        return self.execution.closed_to_events(self.state, self.robot_action)

    @cached_property
    def _ways(self) -> tuple[tuple[Action, ...], ...]:
        """The robot's part of the compound action, in each way in which it may come out."""
        action, execution = self.robot_action, self.execution
        if action is None or not execution.possible(self.state, action):
            return ((),)
        fails = ((),) if execution.chance(action) < 1 else ()
        return (execution.physical(action), *fails)

    @cached_property
    def _all(self) -> tuple[Action, ...]:
        return tuple(filter(self.allows, self.candidates))

    def __contains__(self, event: object) -> bool:
        return isinstance(event, Literal) and event in self.candidates and self.allows(event)

    def __iter__(self) -> Iterator[Action]:
        # `tuple` asks for an iterator, then for the number, and only then for the first item.
        yield from self._all if "_all" in vars(self) else filter(self.allows, self.candidates)

    def __len__(self) -> int:
        return len(self._all)

    def __getitem__(self, index: Any) -> Any:
        return self._all[index]
