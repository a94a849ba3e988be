"""What the checks of a game have in common: faults, and what they know when a decision is made."""

from collections.abc import Collection
from dataclasses import dataclass

from benchmarks.games.explaining import Assumptions, Node, Search
from benchmarks.games.office import Office, State
from benchmarks.games.told import Told
from testbed.protocol import Decision, Percept


@dataclass(frozen=True)
class Fault:
    """What is wrong about a decision, and which check says so."""

    check: str
    step: int
    says: str

    def __str__(self) -> str:
        return f"{self.check} at step {self.step}: {self.says}"


@dataclass(frozen=True)
class Turn:
    """A decision to be checked, and where the robot is.

    `before` is what was left to assume before the decision, `adopted` what the robot assumes now,
    by which the history leads to `ends`; `is_completed` says that only what it assumes of unknown
    fluents changed. `is_limited` says that the game has tight limits of decisions.
    """

    told: Told
    search: Search
    percept: Percept
    decision: Decision
    before: Assumptions
    adopted: Assumptions
    is_completed: bool
    ends: Collection[Node]
    is_proved: bool
    is_limited: bool
    plan_limit: int

    @property
    def step(self) -> int:
        return self.decision.step

    @property
    def office(self) -> Office:
        return self.told.rules.office

    @property
    def state(self) -> State | None:
        """The state that the robot believes in; None: its belief is none, or is not told.

        It is as unsure as it may be: what was not known at the start it is not sure of.
        """
        belief = frozenset(map(str, self.decision.trace.belief))
        states = (node.state for node in self.ends)
        believed = (state for state in states if self.office.fluents(state) - state.sure == belief)
        return min(believed, key=lambda state: len(state.sure), default=None)

    def holds(self, state: State) -> bool:
        """Whether the goal does."""
        return self.office.agrees(state, self.told.rules.goal)

    def fault(self, check: str, says: str) -> Fault:
        return Fault(check, self.step, says)
