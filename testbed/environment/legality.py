"""Legal exogenous actions beside the robot's action, asked for one event or for all."""

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from functools import cached_property, partial
from typing import Any

from asp.language import Action, Literal
from testbed.environment.allowance import Allowance
from testbed.environment.execution import Execution
from testbed.environment.rules import EventRules, Rules, Situation
from testbed.protocol import FINISH, NONE, WAIT
from testbed.search import Reach


class Legality:
    """Says what is legal in a situation. What was asked last is remembered."""

    def __init__(
        self,
        execution: Execution,
        rules: Rules,
        candidates: Sequence[Action],
        allowance: Allowance,
        reach: Reach,
    ) -> None:
        self._execution, self._rules, self._candidates = execution, rules, candidates
        self._allowance, self._reach = allowance, reach
        self._restricted = rules.adversary != EventRules()
        self._last: tuple[tuple[Any, ...], LegalEvents] | None = None

    def events(self, now: Situation, robot_action: Action | None) -> "LegalEvents":
        """The legal events beside the robot's action, which need not be known."""
        left = self._allowance.left(now)
        question = now.state, robot_action, now.goal, left, now.step if self._restricted else 0
        if self._last is None or self._last[0] != question:
            refusal = partial(self._allowance.why_not, left=left, step=now.step)
            found = LegalEvents(
                self._execution,
                self._rules.exogenous_while_thinking,
                self._candidates,
                now.state,
                robot_action,
                refusal if self._restricted else None,
                partial(self._reach, goal=now.goal) if self._rules.adversary.fair else None,
            )
            self._last = question, found
        return self._last[1]


@dataclass(eq=False)
class LegalEvents(Sequence[Action]):
    """The adversary's actions that are legal beside the robot's in a state, in their order.

    An event is legal where it is possible however the robot's action comes out, the rules do not
    refuse it (`refusal` says why they do), and the goal is within reach of each state that it may
    lead to (`in_reach`; None: no matter); doing nothing always is. The robot's action may not be
    known (None). `while_thinking`: waiting lets others act. `in` tests one event, iterating tests
    on. The number of them tests each, and is not asked for a second time by who then iterates.
    """

    execution: Execution
    while_thinking: bool
    candidates: Sequence[Action]
    state: int
    robot_action: Action | None
    refusal: Callable[[Action], str | None] | None = None
    in_reach: Callable[[int], bool | None] | None = None

    def allows(self, event: Action) -> bool:
        """Whether one of the candidates is legal."""
        if event == NONE:
            return True
        return not self._refused(event) and self.possible(event) and not self._unfair(event)

    def possible(self, event: Action) -> bool:
        """Whether an event could happen, whatever the rules leave to the adversary."""
        executable = self.execution.world.executable
        return self._closed is None and all(executable(self.state, (*w, event)) for w in self._ways)

    def why_not(self, event: Action) -> str | None:
        """One line that says why the event is not legal; None if it is."""
        if event == NONE:
            return None
        return self._refused(event) or self._impossible(event) or self._unfair(event)

    def _impossible(self, event: Action) -> str | None:
        why_not = self.execution.world.why_not
        reasons = (why_not(self.state, (*way, event)) for way in self._ways)
        return self._closed or next(filter(None, reasons), None)

    def _refused(self, event: Action) -> str | None:
        return None if self.refusal is None else self.refusal(event)

    def _unfair(self, event: Action) -> str | None:
        """Why an event that is possible is not fair: a state that it may lead to."""
        if self.in_reach is None:
            return None
        successors = self.execution.world.successors
        states = (after for way in self._ways for after in successors(self.state, (*way, event)))
        answers = map(self.in_reach, states) if self._is_searchable else iter([None])
        worst = next((known for known in answers if not known), True)
        if worst is None:
            return "whether the goal can be achieved after it is not known (limits.judge_states)"
        return None if worst else "after it the goal can not be achieved (adversary.fair)"

    @cached_property
    def _is_searchable(self) -> bool:
        """Whether the search's bound suffices for the state itself: else it is not tried on."""
        return self.in_reach is not None and self.in_reach(self.state) is not None

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
