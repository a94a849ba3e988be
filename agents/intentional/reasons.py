"""Why a robot decided as it did: for people, in the terms of the theory.

Nothing here has a part in a decision. Beliefs are projected, cores and explanations found with the
kept controls, whatever the robot itself reasons with.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

from agents.intentional.intention import Intention
from agents.shared.contradictions import Contradicting, holds
from agents.shared.diagnosis import Explained
from agents.shared.history import GOAL, Diagnosis, History
from agents.shared.knowledge import Knowledge
from agents.shared.memory import past_of
from agents.shared.no_plan import GivingUp
from agents.shared.sessions import tools_of
from asp.language import complement
from asp.reasoning.diagnosis import Assumed
from asp.solving import UNLIMITED, LimitError, Limits, State, deciding
from testbed.protocol import Contradiction, Event, Explanation, NoPlan

MOST_ALTERNATIVES = 20

_FIRST_EVENT = 1  # (16): nothing else happens while the goal is selected


@dataclass(frozen=True)
class Why:
    """The reason of a decision; the first step at which the projected plan breaks, if any.

    `no_plan` is why there is no plan, where the robot gives up.
    """

    text: str
    futile_at: int | None = None
    no_plan: NoPlan | None = None


class Reasons:
    """Gives reasons for decisions about one goal in one domain."""

    def __init__(
        self,
        knowledge: Knowledge,
        goal: tuple[str, ...],
        plan_limit: int,
        limits: Limits = UNLIMITED,
    ) -> None:
        self._knowledge = knowledge
        self._tools = tools_of(knowledge)
        self._goal = goal
        self._giving_up = GivingUp(knowledge, goal, plan_limit, limits)
        self._limits = limits
        self._contradicting = Contradicting(knowledge, goal)

    def why(self, history: History, intention: Intention, explained: Explained) -> Why:
        """Why this is intended at the history's step."""
        state, action = intention.believed - {GOAL}, intention.action
        if action == "finish":
            if GOAL in intention.believed:
                return Why("the goal holds")
            no_plan, text = self._giving_up.why(state)
            return Why(text, no_plan=no_plan)
        if action.startswith("start("):
            return Why(_started(history, intention))
        name, index = next(iter(explained.indices.items()))
        left = history.activities[name - 1].plan[index:]
        if action.startswith("stop("):
            return self._futile(history.step, state, left)
        by = history.step + len(left)
        return Why(f"activity {name} still reaches the goal, by step {by}")

    def contradictions(
        self, history: History, adopted: Diagnosis, believed: State, step: int
    ) -> list[Contradiction]:
        """What contradicts the belief of an earlier step, first; `Contradicting`."""
        return self._contradicting.contradictions(history, adopted, believed, step)

    def alternatives(
        self, history: History, explained: Explained
    ) -> tuple[list[Explanation], bool]:
        """The other explanations that are as small, and whether there are more than are given.

        None are given where the limits of a decision do not suffice to find them.
        """
        diagnosis = explained.diagnosis
        try:
            with deciding(self._limits):
                found, more = self._found(history, explained)
        except LimitError:
            return [], True
        others = (
            Diagnosis(
                _events(a.events), _events(a.distrusted), a.exceptions, proved=diagnosis.proved
            )
            for a in found
        )
        own = replace(diagnosis, initial=())
        return [self.explanation(other, history.step) for other in others if other != own], more

    def _found(self, history: History, explained: Explained) -> tuple[list[Assumed], bool]:
        if explained.others is not None:
            return explained.others(MOST_ALTERNATIVES)
        diagnosis = explained.diagnosis
        past = past_of(self._knowledge, self._goal, history, _FIRST_EVENT)
        size = (diagnosis.size, len(diagnosis.exceptions))
        return self._tools.explanations.alternatives(past, size, MOST_ALTERNATIVES)

    def explanation(self, diagnosis: Diagnosis, step: int) -> Explanation:
        """A diagnosis as it travels."""
        return Explanation(
            step=step,
            unobserved=list(diagnosis.unobserved),
            distrusted=list(diagnosis.distrusted),
            exceptions=self._knowledge.against(diagnosis.exceptions),
            minimal="proved" if diagnosis.proved else "unproved",
        )

    def _futile(self, step: int, state: State, left: tuple[str, ...]) -> Why:
        """Where the projection of a plan breaks (36)."""
        for later, action in enumerate(left, start=step):
            after = self._tools.transitions.after(state, action, ())
            if after is None or not after[1]:
                hindrance = self._tools.reach.hindrance(state, action)
                why = f" with {', '.join(hindrance)}" if hindrance else ""
                return Why(f"futile: {action} is impossible at step {later}{why}", later)
            state = after[0]
        end = step + len(left)
        missing = (literal for literal in self._goal if not holds(literal, state))
        failing = ", ".join(complement(literal) for literal in missing)
        return Why(f"futile: its end, at step {end}, violates the goal with {failing}", end)


def _started(history: History, intention: Intention) -> str:
    # A new activity is on record only after the decision.
    again = any(f"start({activity.name})" == intention.action for activity in history.activities)
    count = len(intention.plan)
    return (
        f"no activity for the goal; {count} action{'' if count == 1 else 's'} achieve"
        f"{'s' if count == 1 else ''} it, none fewer"
        + ("; the plan of an earlier activity" * again)
    )


def _events(pairs: tuple[tuple[int, str], ...]) -> tuple[Event, ...]:
    return tuple(Event(step=step, action=action) for step, action in sorted(pairs))
