"""Phase one step by step: beliefs are carried forward, and explained anew where they fail.

What was believed a step ago is carried forward as one state. It is taken back only when an
observation contradicts it; then the whole history is explained anew.
"""

from __future__ import annotations

from collections.abc import Collection, Sequence
from contextlib import suppress
from copy import copy
from dataclasses import replace
from functools import partial
from typing import Generic, Self

from asp.language import Fluent
from asp.reasoning.diagnosis.belief import Belief, Beliefs
from asp.reasoning.diagnosis.explanations import (
    Alternatives,
    Diagnoser,
    Diagnosis,
    Explanation,
    H_contra,
)
from asp.reasoning.diagnosis.history import History, Problem, Record, problem_of, record_of
from asp.reasoning.diagnosis.long_histories.frontier import Compression, Frontier
from asp.reasoning.diagnosis.reference import SEARCH
from asp.reasoning.diagnosis.sessions import DiagnosisSessions
from asp.reasoning.diagnosis.smallest_explanations import Interpretation
from asp.reasoning.knowledge import Goal
from asp.solving import BudgetError, LimitError, State, current, up_to

COMPRESSION: Compression | None = Compression()
"""How long histories are compressed; None: they are not, with the same answers, only later.

It pays in contradictions: one at step 100 takes 2 ms, and 58 without; one that assumes 20 hidden
events takes 3 ms, and 3 s without, with nothing proved. Other decisions take 0.3 ms more.
"""


class IncrementalDiagnoser(Generic[H_contra]):
    """Explains one history for one goal as the reference does, step after step.

    `since` is the first step at which an exogenous action may have occurred. The `reference`
    explains the history where that takes more events than a session counts, or more than the
    budget.
    """

    def __init__(
        self, sessions: DiagnosisSessions, goal: Goal, since: int, reference: Diagnoser[H_contra]
    ) -> None:
        self._sessions = sessions
        self._knowledge = sessions.knowledge
        self._goal = goal
        self._since = since
        self._reference = reference
        self._compression = COMPRESSION
        self._tracker = sessions.tracker(goal, since)
        self._frontier: Frontier | None = None
        self._beliefs: list[Beliefs] = []
        self._under = Explanation()
        self._fewest = (0, 0)
        self._heard = 0
        self._is_late = False
        self._diagnosed = 0

    @property
    def beliefs(self) -> Sequence[Belief]:
        """What the last diagnosis may have led to: several where actions have several outcomes."""
        assert self._beliefs, "a belief follows a diagnosis"
        return self._beliefs[-1]

    @property
    def belief(self) -> Belief:
        """The first of the beliefs."""
        return self.beliefs[0]

    @property
    def frontier(self) -> Frontier | None:
        """What the history is compressed to; None where it is too short."""
        return self._frontier

    def copy(self) -> Self:
        """One that has come as far in its history, which may go on otherwise."""
        other = copy(self)
        other._beliefs = [*self._beliefs]
        other._frontier = None if self._frontier is None else self._frontier.copy()
        return other

    def holds(self, state: State) -> bool:
        """Whether the goal does."""
        return self._tracker.holds(state)

    def diagnose(self, history: H_contra, adopted: Explanation, /) -> Diagnosis:
        """The adopted explanation if it is still as small as any, else the first smallest one.

        Raises InconsistentHistoryError and LimitError.
        """
        self._hear(history)
        # Where the time ran out after late news, the caller holds what it held before the news.
        adopted = adopted.left(history)
        self._compress(history)
        if self._is_late or (self._is_told(history) and not adopted.proved):
            adopted = self._revised(history, adopted)
        if not self._carried(history, adopted):
            adopted = self._explain(history, adopted)
        self._under, self._is_late, self._diagnosed = adopted, False, history.step
        return Diagnosis(adopted, alternatives=partial(self._alternatives, history, adopted))

    def _is_told(self, history: History) -> bool:
        """Whether an event was reported since the last diagnosis that came to an end."""
        since, events = min(self._diagnosed, history.step - 1), self._knowledge.actions[1]
        return any(events & history.at(i).happened.keys() for i in range(since, history.step))

    def _hear(self, history: History) -> None:
        """Takes back what late news of the past may change."""
        news = history.late_news[self._heard :]
        if news:
            self._heard += len(news)
            self._fewest = (0, 0)
            del self._beliefs[max(1, min(news)) :]
            if self._frontier is not None:
                self._frontier.forget(min(news))
            self._is_late = True  # until a diagnosis comes to an end

    def _carried(self, history: History, adopted: Explanation) -> bool:
        """Whether what is adopted agrees with all that was observed; it is believed if it does."""
        if adopted != self._under.left(history):
            self._beliefs = []
        if not self._beliefs:
            self._under, first = adopted, self._first(history, adopted)
            if first is None:
                return False
            self._beliefs = [(first,)]
        return self._tracker.carry(self._beliefs, history, adopted)

    def _revised(self, history: History, adopted: Explanation) -> Explanation:
        """What news leaves of the adopted explanation: nothing where another one is smaller."""
        found = self._smallest(history)
        if found is None:
            return replace(adopted, proved=False)
        if adopted.price > found.explanation.price:
            return Explanation()
        return replace(adopted, proved=found.explanation.proved)

    def _compress(self, history: History) -> None:
        """Compresses a little more of the history.

        Where the decision reaches one of its limits, this is left for later: it only saves time.
        """
        settings = self._compression
        if settings is None or history.step <= settings.after:
            return
        if self._frontier is None:
            sessions = self._sessions
            self._frontier = Frontier(sessions.arcs, sessions.explanations, self._tracker, settings)
        with suppress(LimitError):
            self._frontier.follow(history)

    def _explain(self, history: H_contra, adopted: Explanation) -> Explanation:
        """The explanation of the whole history; the belief becomes what it implies."""
        unknown = self._unknown(history)
        found = self._keeping(history, adopted) if unknown else None
        found = found or self._smallest(history)
        if found is None:
            explanation = self._reference.diagnose(history, adopted).explanation
            start = self._first(history, explanation)
            assert start is not None, "an explanation says how it began"
            self._beliefs = [(start,)]
            carried = self._tracker.carry(self._beliefs, history, explanation, trusting=True)
            assert carried, "an explanation explains every step from the first on"
        else:
            explanation = self._adopt(found, history, unknown)
        if explanation.proved and explanation.without_start != adopted.without_start:
            self._fewest = (explanation.size, len(explanation.exceptions))
        return explanation

    def _keeping(self, history: History, adopted: Explanation) -> Interpretation | None:
        """The first interpretation with what is adopted of events, reports and exceptions."""
        least = self._frontier and self._frontier.least(history)
        if least is None:
            explanations = self._sessions.explanations
            return explanations.keeping(self._problem(history), adopted)
        assert self._frontier is not None
        return self._frontier.keeping(history, adopted) if adopted.price == least else None

    def _smallest(self, history: History) -> Interpretation | None:
        """The smallest explanation; None where that takes another way, or more than the budget."""
        try:
            with up_to(SEARCH):
                current().check_conflicts()
                frontier, explanations = self._frontier, self._sessions.explanations
                found = None if frontier is None else frontier.smallest(history)
                return found or explanations.smallest(self._problem(history), self._fewest)
        except BudgetError:
            return None

    def _adopt(
        self, found: Interpretation, history: History, unknown: Collection[Fluent]
    ) -> Explanation:
        """The explanation that was found; the beliefs become what it leads to."""
        initial = sorted(f if f in found.states[0] else f.complement for f in unknown)
        explanation = replace(found.explanation, initial=tuple(initial))
        self._beliefs = self._tracker.along(found.states)
        if not self._knowledge.deterministic:  # other outcomes may agree with it, too
            self._beliefs = self._beliefs[:1]
            self._tracker.carry(self._beliefs, history, explanation)
        return explanation

    def _alternatives(self, history: History, adopted: Explanation, most: int) -> Alternatives:
        """At most so many explanations of the size of one, and whether there are more of them."""
        frontier, explanations = self._frontier, self._sessions.explanations
        found = None if frontier is None else frontier.alternatives(history, adopted, most)
        return found or explanations.alternatives(self._problem(history), adopted, most)

    def _first(self, history: History, adopted: Explanation) -> Belief | None:
        """The belief at step 0, if the adopted explanation says how it began."""
        if {literal.atom for literal in adopted.initial} != set(self._unknown(history)):
            return None
        description = self._knowledge.description
        observed = record_of(history.at(0), self._knowledge).observed
        state = frozenset(each for each in observed if each.is_positive)
        if adopted.initial or description.defaults:
            records = {0: Record(observed=(*observed, *adopted.initial))}
            start = self._sessions.explanations.smallest(Problem(self._goal, records, 0, 0))
            if start is None or start.explanation.exceptions != adopted.exceptions:
                return None
            state = start.states[0]
        elif not self._sessions.transitions.satisfiable(observed) or any(
            state.isdisjoint(some) for some in description.initially
        ):
            return None
        return self._tracker.start(state)

    def _problem(self, history: History) -> Problem:
        return problem_of(self._knowledge, self._goal, history, self._since)

    def _unknown(self, history: History) -> list[Fluent]:
        """The inertial fluents of which nothing was observed at step 0."""
        known = history.at(0).observed
        return [fluent for fluent in self._knowledge.description.inertial if fluent not in known]
