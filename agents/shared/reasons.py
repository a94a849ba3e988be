"""Reasons of decisions in words: for people, with no part in a decision."""

from collections.abc import Collection, Mapping
from types import MappingProxyType

from agents.shared.narration import Narration
from agents.shared.reasoning import limits_of, sessions_of
from asp.language import Action, Fluent
from asp.reasoning import Knowledge
from asp.reasoning.diagnosis import Explanation, Happening, History, record_of
from asp.solving import LimitError, State, deciding
from testbed import protocol
from testbed.protocol import Contradiction, Event, NoPlan, Task


class Reasons:
    """Tells of decisions about one goal in one domain, whatever the robot reasons with."""

    def __init__(self, knowledge: Knowledge, task: Task) -> None:
        self._knowledge, self._task = knowledge, task
        self._goal = tuple(task.goal)
        self._limits = limits_of(task)
        self._sessions = sessions_of(knowledge)
        self._tracker = self._sessions.diagnosis.tracker(self._goal)
        self._is_conformant = task.plans == "conformant" and not knowledge.deterministic

    def explanation(
        self,
        explanation: Explanation,
        misread: Collection[Happening],
        outcome: Happening | None,
        step: int,
    ) -> protocol.Explanation:
        """An explanation found at a step as it travels.

        With the tests that were wrong, and the action that had another outcome than expected.
        """
        return protocol.Explanation(
            step=step,
            unobserved=_events(explanation.unobserved),
            distrusted=_events((*explanation.distrusted, *misread)),
            outcomes=_events([outcome] if outcome else []),
            exceptions=self._knowledge.against(explanation.exceptions),
            minimal="proved" if explanation.proved else "unproved",
        )

    def contradictions(
        self,
        history: History,
        adopted: Explanation,
        believed: State,
        step: int,
        expected: Mapping[int, State] = MappingProxyType({}),
    ) -> list[Contradiction]:
        """What contradicts the belief of an earlier step, projected with what was adopted.

        Of all steps the first one at which something does, with everything that does there. Where
        actions may have several outcomes the states of later steps are those `expected`.
        """
        state, adopted = believed, adopted.left(history)
        while True:
            moment = history.at(step)
            found = self._tracker.surprises(moment, state)
            if found or step >= history.step:
                return [
                    Contradiction(step=step, observed=seen, believed=seen.complement)
                    for seen in found
                ]
            record = record_of(moment, self._knowledge)
            attempt, events = adopted.executed(record, step), adopted.happened(record, step)
            after = self._sessions.transitions.after(state, attempt, events)
            if after is None:
                return self._impossible(events, state, step)
            if attempt is not None and after[1] != moment.happened.get(attempt):
                seen = attempt.complement if after[1] else attempt
                sides = _in("hpd", seen), _in("hpd", seen.complement)
                return [Contradiction(step=step, observed=sides[0], believed=sides[1])]
            step += 1
            state = expected.get(step, after[0])

    def no_plan(self, believed: Collection[Fluent]) -> tuple[NoPlan, str]:
        """Why no plan within the limit was found from what is believed, as a key and in words.

        What is believed need not be so.
        """
        within = f"no plan of at most {self._task.plan_limit} actions achieves the goal"
        if self._is_conformant:
            within += " with all outcomes"
        try:
            with deciding(self._limits):
                reachable = self._sessions.reach.reachable(frozenset(believed), self._goal)
        except LimitError:
            reachable = None
        if self._is_conformant and reachable:
            reachable = None  # with some outcomes, which does not suffice
        if reachable is None:
            return "not known", f"{within}; whether a longer one does is not known"
        if reachable:
            return "beyond the limit", f"{within}; from what it believes a longer one does"
        said = "from what it believes, the goal is out of reach: no plan of any length"
        return "out of reach", f"{said} achieves it"

    def _impossible(
        self, events: tuple[Action, ...], state: State, step: int
    ) -> list[Contradiction]:
        """The reports that cannot be true; all of them, where they only exclude each other."""
        transitions = self._sessions.transitions
        alone = [e for e in events if transitions.after(state, None, (e,)) is None]
        return [
            Contradiction(step=step, observed=_in("hpd", e), believed=_in("impossible", e))
            for e in alone or events
        ]


def _events(happenings: Collection[Happening]) -> list[Event]:
    return [Event(step=step, action=action) for step, action in happenings]


def _in(predicate: str, action: Action) -> Narration:
    return Narration(f"{predicate}(", action, ")")
