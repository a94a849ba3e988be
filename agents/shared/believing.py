"""Phase one on kept controls: what a robot believes, and the explanation behind it.

What was believed a step ago is carried forward as one state. It is taken back only when an
observation contradicts it; then the whole history is explained anew.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import dataclass, replace

from agents.shared.history import GOAL, Diagnosis, History, Moment
from agents.shared.knowledge import Knowledge
from agents.shared.tools import tools_of
from asp.kept.control import State
from asp.kept.explanations import Record
from asp.literals import atom, is_positive
from testbed.link.messages import Event


@dataclass(frozen=True)
class Belief:
    """What the adopted history says of a step, and the steps up to it at which the goal held."""

    step: int
    state: State
    held: frozenset[int]


class Believer:
    """Explains one history after another step of it, as `diagnose` does, for one trial.

    `since` is the first step at which an exogenous action may have occurred. `plain` explains the
    history where that takes more events than the kept control counts.
    """

    def __init__(
        self,
        knowledge: Knowledge,
        goal: tuple[str, ...],
        since: int,
        plain: Callable[[History, Diagnosis], Diagnosis],
    ) -> None:
        self._tools = tools_of(knowledge)
        self._actions = frozenset(knowledge.description.agent_actions)
        self._events = frozenset(knowledge.description.exogenous_actions)
        self._goal = goal
        self._since = since
        self._plain = plain
        self._belief: Belief | None = None
        self._fewest = 0
        self._late_news = 0

    @property
    def belief(self) -> Belief:
        """What is believed since the last diagnosis."""
        assert self._belief is not None, "a belief follows a diagnosis"
        return self._belief

    def diagnose(self, history: History, adopted: Diagnosis) -> tuple[Diagnosis, bool]:
        """The explanation up to the history's step, and whether it is the adopted one.

        Raises InconsistentHistoryError.
        """
        if history.late_news > self._late_news:
            self._late_news = history.late_news
            self._belief, self._fewest = None, 0
            adopted = _without_reported(history, adopted)
        carried = self._carry(history, adopted)
        if carried is not None:
            self._belief = carried
            return adopted, True
        return self._explain(history, adopted), False

    def holds(self, state: State) -> bool:
        """Whether the goal does."""
        return all((atom(literal) in state) == is_positive(literal) for literal in self._goal)

    def _carry(self, history: History, adopted: Diagnosis) -> Belief | None:
        """The belief at this step, if what is new agrees with the adopted explanation."""
        belief: Belief | None = self._belief or self._first(history)
        while belief is not None and self._agrees(history.at(belief.step), belief.state):
            if belief.step == history.step:
                return belief
            belief = self._advance(belief, history, adopted)
        return None

    def _advance(self, belief: Belief, history: History, adopted: Diagnosis) -> Belief | None:
        """The belief a step later, if what happened there agrees with the explanation."""
        step = belief.step
        record = self._record(history.at(step))
        attempt = None if record.attempt is None else record.attempt[0]
        events = _happened(record, adopted, step)
        if events and step < self._since:
            return None
        after = self._tools.transitions.after(belief.state, attempt, events)
        if after is None or (record.attempt is not None and record.attempt[1] != after[1]):
            return None
        return self._next(belief, after[0])

    def _explain(self, history: History, adopted: Diagnosis) -> Diagnosis:
        """The smallest explanation of the whole history; the belief becomes what it implies."""
        account = self._tools.explanations.smallest(
            self._first(history).state,
            self._goal,
            {step: self._record(moment) for step, moment in history.moments.items()},
            history.step,
            fewest=self._fewest,
            since=self._since,
        )
        if account is None:
            diagnosis = self._plain(history, adopted)
            self._belief = self._replay(history, diagnosis)
        else:
            diagnosis = Diagnosis(_events(account.events), _events(account.distrusted))
            self._belief = Belief(history.step, account.state, account.held)
        self._fewest = diagnosis.size
        return diagnosis

    def _first(self, history: History) -> Belief:
        """The belief at step 0, of which everything was observed."""
        state = frozenset(f for f, truth in history.at(0).observed.items() if truth)
        return Belief(0, state, frozenset([0]) if self.holds(state) else frozenset())

    def _next(self, belief: Belief, state: State) -> Belief:
        step = belief.step + 1
        return Belief(step, state, belief.held | {step} if self.holds(state) else belief.held)

    def _replay(self, history: History, diagnosis: Diagnosis) -> Belief:
        """The belief at the history's step with this explanation of it."""
        belief = self._first(history)
        while belief.step < history.step:
            after = self._advance(belief, history, diagnosis)
            assert after is not None, "an explanation explains every step"
            belief = after
        return belief

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
            truth == (self.holds(state) if fluent == GOAL else fluent in state)
            for fluent, truth in moment.observed.items()
        )


def _happened(record: Record, diagnosis: Diagnosis, step: int) -> tuple[str, ...]:
    """The exogenous actions of a step, given an explanation."""
    false = {report.action for report in diagnosis.distrusted if report.step == step}
    unobserved = (event.action for event in diagnosis.unobserved if event.step == step)
    return (*(event for event in record.reported if event not in false), *unobserved)


def _without_reported(history: History, adopted: Diagnosis) -> Diagnosis:
    """What is left to assume of an explanation where some of its events were reported since."""
    unobserved = (e for e in adopted.unobserved if not history.at(e.step).happened.get(e.action))
    return replace(adopted, unobserved=tuple(unobserved))


def _events(pairs: Iterable[tuple[int, str]]) -> tuple[Event, ...]:
    return tuple(Event(step=step, action=action) for step, action in sorted(pairs))
