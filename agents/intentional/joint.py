"""The original theory of intentions (TI): all explanations are considered while planning."""

from __future__ import annotations

from dataclasses import replace

from clingo import Symbol

from agents.intentional.history import History
from agents.intentional.reference import ReferenceReasoner, read_intention
from agents.shared.thought import Intention
from asp.reasoning.diagnosis import Diagnosis, Explanation, diagnosis_of
from asp.solving import fact, first_model, ground, theory

_EXPLAINING = ("defaults", "diagnosis")
_INACTIVE = ("finishes", "starts")
_ACTIVE = ("goes_on", "finishes", "stops")


class JointReasoner(ReferenceReasoner):
    """Reasons about one goal in one domain; every call solves its program from scratch.

    Phase one finds how few events and exceptions explain the history, phase two the intention, in
    one program with every explanation that takes no more of them.
    """

    def diagnose(self, history: History, adopted: Explanation, /) -> Diagnosis:
        """The first of all smallest explanations; none is kept. Raises InconsistentHistoryError."""
        return self._diagnose(history, adopted, keeps=False)

    def intend(self, history: History, diagnosis: Diagnosis, /) -> Intention:
        """The intention that is best under any smallest explanation; its `under` says which.

        An activity that may still succeed is gone on with, and one that cannot is stopped. Without
        one the agent finishes if the goal may hold, else it starts the shortest plan that may
        reach it. Beyond the plan limit the goal is futile.
        """
        if diagnosis.indices:
            return self._with_activity(history, diagnosis)
        for length in range(1, self._plan_limit + 1):
            intention = self._look(history, diagnosis.explanation, length, _INACTIVE)
            if intention is not None:
                return intention
        given_up = (fact("beyond_limit"),)
        return _found(self._look(history, diagnosis.explanation, 1, _INACTIVE, given_up))

    def _with_activity(self, history: History, diagnosis: Diagnosis) -> Intention:
        # Under another explanation more of the plan may be left than under the first one.
        length = max(len(history.activities[name - 1].plan) for name in diagnosis.indices)
        return _found(self._look(history, diagnosis.explanation, length, _ACTIVE))

    def _look(
        self,
        history: History,
        explanation: Explanation,
        length: int,
        kinds: tuple[str, ...],
        more: tuple[Symbol, ...] = (),
    ) -> Intention | None:
        """The intention of the first kind that there is, if `length` more actions are considered.

        Of the explanation only the numbers of events and exceptions count.
        """
        constants = self._constants(history, history.step + 1 + length, length)
        most = explanation.size
        texts = [theory(name) for name in (*_EXPLAINING, "planning", "joint")]
        facts = [*self._facts(history), fact("explaining", history.step), *more]
        control = ground([*self._base, *texts], {**constants, "max_unobserved": most}, facts)
        smallest = [
            (fact("number_unobserved", most, history.step), True),
            (fact("number_exceptions", len(explanation.exceptions)), True),
        ]
        for kind in kinds:
            model = first_model(control, [*smallest, (fact(kind), True)])
            if model is not None:
                under = diagnosis_of(model, explanation.proved)
                return replace(read_intention(model), under=under)
        return None


def _found(intention: Intention | None) -> Intention:
    assert intention is not None, "(53): an agent always has an intention"
    return intention
