"""The two phases of reasoning on kept controls: the same answers as the theory solved from scratch.

What was believed a step ago is carried forward as one state. It is taken back only when an
observation contradicts it; then the whole history is explained anew.
"""

from __future__ import annotations

from dataclasses import dataclass

from agents.intentional.intention import Intention
from agents.intentional.logician import Logician
from agents.shared.diagnosis import Explained
from agents.shared.history import GOAL, Diagnosis, History, Moment
from agents.shared.knowledge import Knowledge
from asp.kept.control import State
from asp.kept.explanations import Explanations, Record
from asp.kept.plans import Plans
from asp.kept.transitions import Transitions
from asp.literals import atom, is_positive
from testbed.link.messages import Event


@dataclass(frozen=True)
class Tools:
    """The kept controls of one domain; they outlive goals and trials."""

    transitions: Transitions
    explanations: Explanations
    plans: Plans


_TOOLS: dict[str, Tools] = {}


def tools_of(knowledge: Knowledge) -> Tools:
    """The kept controls of a domain, made once in a process."""
    if knowledge.program not in _TOOLS:
        description, program, ranks = knowledge.description, knowledge.program, knowledge.ranks
        fluents = description.fluents
        _TOOLS[knowledge.program] = Tools(
            Transitions(program, fluents, ranks),
            Explanations(program, fluents, description.exogenous_actions, ranks),
            Plans(program, fluents, description.agent_actions, ranks),
        )
    return _TOOLS[knowledge.program]


@dataclass(frozen=True)
class Belief:
    """What the adopted history says of a step; `reached`: the goal has held at some step."""

    step: int
    state: State
    reached: bool


class KeptLogician:
    """Reasons about one goal in one domain, as `Logician` does, for one trial."""

    def __init__(self, knowledge: Knowledge, goal: tuple[str, ...], plan_limit: int) -> None:
        """`plan_limit` is the greatest number of actions in a plan."""
        self._tools = tools_of(knowledge)
        self._plain = Logician(knowledge, goal, plan_limit)
        self._actions = frozenset(knowledge.description.agent_actions)
        self._events = frozenset(knowledge.description.exogenous_actions)
        self._goal = goal
        self._plan_limit = plan_limit
        self._belief: Belief | None = None
        self._indices: dict[int, int] = {}

    def diagnose(self, history: History, adopted: Diagnosis) -> Explained:
        """Phase one. Raises InconsistentHistoryError."""
        self._follow(history)
        carried = self._carry(history)
        if carried is not None:
            self._belief = carried
            return Explained(adopted, True, dict(self._indices))
        diagnosis = self._explain(history, adopted)
        return Explained(diagnosis, False, dict(self._indices))

    def intend(self, history: History, explained: Explained) -> Intention:
        """Phase two."""
        assert self._belief is not None, "an intention follows a diagnosis"
        action, plan = self._decide(self._belief, history, explained)
        state = self._belief.state
        return Intention(action, plan, state | {GOAL} if self._holds(state) else state)

    def _decide(
        self, belief: Belief, history: History, explained: Explained
    ) -> tuple[str, tuple[str, ...]]:
        if belief.reached:  # (7), (32)-(34): the goal holds, or has held
            return "finish", ()
        for name, index in explained.indices.items():
            left = history.activities[name - 1].plan[index:]
            if left and self._tools.plans.succeeds(belief.state, self._goal, left):
                return left[0], ()  # (38)
            return f"stop({name})", ()  # (41)
        plan = self._tools.plans.shortest(belief.state, self._goal, self._plan_limit)
        if plan is None:
            return "finish", ()  # (53)
        earlier = (activity.name for activity in history.activities if activity.plan == plan)
        return f"start({next(earlier, len(history.activities) + 1)})", plan  # (42), (52)

    def _carry(self, history: History) -> Belief | None:
        """The belief at this step, if what is new agrees with the belief at the last one."""
        belief = self._belief or self._first(history)
        if belief.step != history.step - 1:
            return None
        before, now = history.at(belief.step), history.at(history.step)
        record = self._record(before)
        attempt = None if record.attempt is None else record.attempt[0]
        after = self._tools.transitions.after(belief.state, attempt, record.reported)
        if after is None or not self._agrees(before, belief.state):
            return None
        state, happened = after
        if record.attempt is not None and record.attempt[1] != happened:
            return None
        if not self._agrees(now, state):
            return None
        return Belief(history.step, state, belief.reached or self._holds(state))

    def _explain(self, history: History, adopted: Diagnosis) -> Diagnosis:
        """The smallest explanation of the whole history; the belief becomes what it implies."""
        account = self._tools.explanations.smallest(
            self._first(history).state,
            self._goal,
            {step: self._record(moment) for step, moment in history.moments.items()},
            history.step,
            fewest=len(adopted.unobserved),
        )
        if account is None:
            diagnosis = self._plain.diagnose(history, adopted).diagnosis
            self._belief = self._replay(history, diagnosis)
            return diagnosis
        self._belief = Belief(history.step, account.state, account.reached)
        return Diagnosis(tuple(Event(step=step, action=name) for step, name in account.events))

    def _first(self, history: History) -> Belief:
        """The belief at step 0, of which everything was observed."""
        state = frozenset(f for f, truth in history.at(0).observed.items() if truth)
        return Belief(0, state, self._holds(state))

    def _replay(self, history: History, diagnosis: Diagnosis) -> Belief:
        """The belief at the history's step with these unobserved events."""
        belief = self._first(history)
        for step in range(history.step):
            record = self._record(history.at(step))
            unobserved = (event.action for event in diagnosis.unobserved if event.step == step)
            attempt = None if record.attempt is None else record.attempt[0]
            events = (*record.reported, *unobserved)
            after = self._tools.transitions.after(belief.state, attempt, events)
            assert after is not None, "an explanation explains every step"
            belief = Belief(step + 1, after[0], belief.reached or self._holds(after[0]))
        return belief

    def _follow(self, history: History) -> None:
        """Brings the index of the active activity up to date (1), (3)."""
        last = history.at(history.step - 1)
        for action in last.attempted:
            kind, _, name = action.rstrip(")").partition("(")
            if kind == "start":
                self._indices = {int(name): 0}
            elif kind == "stop":
                self._indices = {}
            elif last.happened.get(action):
                self._indices = {
                    name: index
                    + (history.activities[name - 1].plan[index : index + 1] == (action,))
                    for name, index in self._indices.items()
                }

    def _record(self, moment: Moment) -> Record:
        """A moment without the mental part of the theory."""
        physical = next((a for a in moment.attempted if a in self._actions), None)
        return Record(
            observed=tuple(
                fluent if truth else f"-{fluent}"
                for fluent, truth in moment.observed.items()
                if fluent != GOAL
            ),
            attempt=None if physical is None else (physical, moment.happened[physical]),
            reported=tuple(
                a for a, truth in moment.happened.items() if truth and a in self._events
            ),
            goal=moment.observed.get(GOAL),
        )

    def _agrees(self, moment: Moment, state: State) -> bool:
        """Whether what was observed at a moment is so in the state."""
        return all(
            truth == (self._holds(state) if fluent == GOAL else fluent in state)
            for fluent, truth in moment.observed.items()
        )

    def _holds(self, state: State) -> bool:
        return all((atom(literal) in state) == is_positive(literal) for literal in self._goal)
