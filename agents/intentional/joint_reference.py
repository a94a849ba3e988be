"""The original theory of intentions (TI) to the letter: one program, solved in one call."""

from __future__ import annotations

from dataclasses import replace

from agents.intentional.history import History
from agents.intentional.reference import ReferenceReasoner, read_intention
from agents.shared.thought import Intention
from asp.reasoning.diagnosis import Diagnosis, Explanation, diagnosis_of, event_limits
from asp.solving import fact, ground, optimal_model, theory

_THEORIES = ("defaults", "diagnosis", "planning", "joint", "undivided")


class JointReferenceReasoner(ReferenceReasoner):
    """Finds explanation and intention together; what `JointReasoner` is held equal to.

    Nothing is known beforehand, neither how few events explain the history nor how long a shortest
    plan is, and the horizon lets a plan be as long as the limit: for small domains only.
    """

    def diagnose(self, _history: History, adopted: Explanation, /) -> Diagnosis:
        """What was held before: there is no phase of its own."""
        return Diagnosis(adopted)

    def intend(self, history: History, diagnosis: Diagnosis, /) -> Intention:
        """The intention for which CR rules are used least. Raises InconsistentHistoryError."""
        facts = [*self._facts(history), fact("explaining", history.step)]
        texts = [*self._base, *map(theory, _THEORIES)]
        longest = max(self._plan_limit, history.longest)
        constants = self._constants(history, history.step + 1 + longest, longest)
        constants["plan_limit"] = self._plan_limit

        def best(most: int) -> Intention | None:
            control = ground(texts, {**constants, "max_unobserved": most}, facts)
            model, proved = optimal_model(control)
            if model is None:
                return None
            return replace(read_intention(model), under=diagnosis_of(model, proved))

        limits = event_limits(self._base[0], facts, history.step, diagnosis.explanation.size)
        return next(filter(None, map(best, limits)))
