"""What was observed against what was believed: for people, with no part in a decision."""

from __future__ import annotations

from agents.shared.history import GOAL, Diagnosis, History, Moment
from agents.shared.knowledge import Knowledge
from agents.shared.sessions import tools_of
from asp.language import atom, complement, is_positive
from asp.solving import State
from testbed.protocol import Contradiction, Event


class Contradicting:
    """Finds contradictions in histories of one domain, for one goal."""

    def __init__(self, knowledge: Knowledge, goal: tuple[str, ...]) -> None:
        self._transitions = tools_of(knowledge).transitions
        self._goal = goal
        self._actions = frozenset(knowledge.description.agent_actions)
        self._events = frozenset(knowledge.description.exogenous_actions)

    def contradictions(
        self, history: History, adopted: Diagnosis, believed: State, step: int
    ) -> list[Contradiction]:
        """What contradicts the belief of an earlier step, first, projected with what was adopted.

        Of all steps the first one at which something does, with everything that does there.
        """
        state = believed
        while True:
            moment = history.at(step)
            found = self._unexpected(moment, state, step)
            if found or step >= history.step:
                return found
            attempt = self._executed(moment, adopted, step)
            events = self._trusted(moment, adopted, step)
            after = self._transitions.after(state, attempt, events)
            if after is None:
                return self._impossible(events, state, step)
            if attempt is not None and after[1] != moment.happened.get(attempt):
                return [_result(attempt, after[1], step)]
            state, step = after[0], step + 1

    def _unexpected(self, moment: Moment, state: State, step: int) -> list[Contradiction]:
        found = []
        for fluent, truth in moment.trusted.items():
            if fluent == GOAL:
                believed = all(holds(literal, state) for literal in self._goal)
            else:
                believed = fluent in state
            if believed != truth:
                literal = fluent if truth else f"-{fluent}"
                found.append(
                    Contradiction(step=step, observed=literal, believed=complement(literal))
                )
        return found

    def _executed(self, moment: Moment, adopted: Diagnosis, step: int) -> str | None:
        attempts = (action for action in moment.attempted if action in self._actions)
        trusted = (a for a in attempts if Event(step=step, action=a) not in adopted.distrusted)
        return next(trusted, None)

    def _trusted(self, moment: Moment, adopted: Diagnosis, step: int) -> tuple[str, ...]:
        false = {report.action for report in adopted.distrusted if report.step == step}
        reported = [a for a, truth in moment.happened.items() if truth and a in self._events]
        unobserved = [
            event.action
            for event in adopted.unobserved
            if event.step == step and event.action not in reported
        ]
        return (*(event for event in reported if event not in false), *unobserved)

    def _impossible(self, events: tuple[str, ...], state: State, step: int) -> list[Contradiction]:
        """The reports that cannot be true; all of them, where they only exclude each other."""
        alone = [e for e in events if self._transitions.after(state, None, (e,)) is None]
        return [
            Contradiction(step=step, observed=f"hpd({event})", believed=f"impossible({event})")
            for event in alone or events
        ]


def holds(literal: str, state: State) -> bool:
    """Whether a literal is true in a state."""
    return (atom(literal) in state) == is_positive(literal)


def _result(attempt: str, expected: bool, step: int) -> Contradiction:
    signs = ("-", "") if expected else ("", "-")
    observed, believed = (f"hpd({sign}{attempt})" for sign in signs)
    return Contradiction(step=step, observed=observed, believed=believed)
