"""Phase one on kept controls: what a robot believes, and the explanation behind it.

What was believed a step ago is carried forward as one state. It is taken back only when an
observation contradicts it; then the whole history is explained anew.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable

from agents.shared.assuming import assumed_in, events_of, without_reported
from agents.shared.following import Belief, Follower
from agents.shared.history import Diagnosis, History
from agents.shared.knowledge import Knowledge
from agents.shared.limits import SEARCH
from agents.shared.memory import PACE, Memory, record_of
from agents.shared.sessions import tools_of
from asp.language import atom, is_positive
from asp.reasoning.diagnosis import Account, Assumed, Pace, Past, Record
from asp.solving import BudgetError, State, current, up_to


class Believer:
    """Explains one history after another step of it, as `diagnose` does, for one trial.

    `since` is the first step at which an exogenous action may have occurred. `plain` explains the
    history where that takes more events than the kept control counts, or more than the budget.
    """

    def __init__(
        self,
        knowledge: Knowledge,
        goal: tuple[str, ...],
        since: int,
        plain: Callable[[History, Diagnosis], Diagnosis],
        pace: Pace = PACE,
    ) -> None:
        self._knowledge = knowledge
        self._tools = tools_of(knowledge)
        self._follower = Follower(knowledge, goal, since)
        self._memory = Memory(knowledge, goal, since, self._follower.holds, pace)
        self._has_defaults = bool(knowledge.description.defaults)
        self._goal = goal
        self._plain = plain
        self._belief: Belief | None = None
        self._fewest = (0, 0)
        self._late_news = 0

    @property
    def belief(self) -> Belief:
        """What is believed since the last diagnosis."""
        assert self._belief is not None, "a belief follows a diagnosis"
        return self._belief

    @property
    def folded(self) -> int:
        """The step up to which the past is folded; 0: it is not."""
        folding = self._memory.folding
        return folding.step if folding else 0

    @property
    def kept(self) -> int:
        """How much is kept for folding, in explanations and transitions."""
        folding = self._memory.folding
        return folding.size if folding else 0

    def diagnose(self, history: History, adopted: Diagnosis) -> tuple[Diagnosis, bool]:
        """The explanation up to the history's step, and whether it is the adopted one.

        Raises InconsistentHistoryError.
        """
        self._memory.record(history)
        if history.late_news > self._late_news:
            self._late_news = history.late_news
            self._belief, self._fewest = None, (0, 0)
        # Where the time ran out after late news, the caller holds what it held before the news.
        adopted = without_reported(history, adopted)
        self._memory.fold(history)
        diagnosis, carried = adopted, self._carry(history, adopted)
        if carried is not None:
            self._belief = carried
        else:
            diagnosis = self._explain(history, adopted)
        return diagnosis, diagnosis == adopted

    def alternatives(
        self, history: History, diagnosis: Diagnosis, most: int
    ) -> tuple[list[Assumed], bool]:
        """At most so many explanations of the size of one, and whether there are more of them."""
        past, folding = self._memory.past(history), self._memory.folding
        found = folding.alternatives(past, diagnosis.size, most) if folding else None
        if found is not None:
            return found
        size = (diagnosis.size, len(diagnosis.exceptions))
        return self._tools.explanations.alternatives(past, size, most)

    def holds(self, state: State) -> bool:
        """Whether the goal does."""
        return self._follower.holds(state)

    def _carry(self, history: History, adopted: Diagnosis) -> Belief | None:
        """The belief at this step, if what is new agrees with the adopted explanation."""
        belief: Belief | None = (
            self._belief or self._folded(adopted) or self._first(history, adopted)
        )
        return belief and self._follower.carried(belief, history, adopted)

    def _explain(self, history: History, adopted: Diagnosis) -> Diagnosis:
        """The explanation of the whole history; the belief becomes what it implies."""
        explanations, past = self._tools.explanations, self._memory.past(history)
        unknown = self._memory.unknown(history)
        if unknown:
            account = explanations.keeping(past, assumed_in(adopted))
            if account is not None:
                return self._adopt(account, history, unknown)
        account = self._smallest(past)
        if account is None:
            diagnosis = self._plain(history, adopted)
            start = self._first(history, diagnosis)
            assert start is not None, "an explanation says how it began"
            self._belief = self._follower.replayed(start, history, diagnosis)
        else:
            diagnosis = self._adopt(account, history, unknown)
        if diagnosis.proved and assumed_in(diagnosis) != assumed_in(adopted):
            self._fewest = (diagnosis.size, len(diagnosis.exceptions))
        return diagnosis

    def _smallest(self, past: Past) -> Account | None:
        """The smallest explanation; None where that takes another way, or more than the budget."""
        folding = self._memory.folding
        try:
            with up_to(SEARCH):
                current().check_conflicts()
                account = folding.smallest(past, self._fewest[0]) if folding else None
                return account or self._tools.explanations.smallest(past, self._fewest)
        except BudgetError:
            return None

    def _adopt(self, account: Account, history: History, unknown: Iterable[str]) -> Diagnosis:
        """The account as an explanation; the belief becomes what it leads to."""
        self._belief = Belief(history.step, account.state, account.held)
        assumed = account.assumed
        return Diagnosis(
            events_of(assumed.events),
            events_of(assumed.distrusted),
            tuple(sorted(assumed.exceptions)),
            tuple(sorted(f if f in account.initial else f"-{f}" for f in unknown)),
        )

    def _first(self, history: History, adopted: Diagnosis) -> Belief | None:
        """The belief at step 0, if the adopted explanation says how it began."""
        if {atom(literal) for literal in adopted.initial} != set(self._memory.unknown(history)):
            return None
        observed = record_of(self._knowledge, history.at(0)).observed
        state = frozenset(filter(is_positive, observed))
        if adopted.initial or self._has_defaults:
            records = {0: Record(observed=(*observed, *adopted.initial))}
            began = self._tools.explanations.smallest(Past(self._goal, records, 0, 0))
            if began is None or set(began.assumed.exceptions) != set(adopted.exceptions):
                return None
            state = began.initial
        return self._follower.start(state)

    def _folded(self, adopted: Diagnosis) -> Belief | None:
        """The belief at the step up to which the history is folded, if that is remembered."""
        folding = self._memory.folding
        found = folding.along(assumed_in(adopted)) if folding else None
        return Belief(folding.step, *found) if folding and found else None
