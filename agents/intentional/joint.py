"""The original theory of intentions (TI): all explanations are considered while planning.

`JointReferenceReasoner` is the theory to the letter, one program that is solved in one call.
"""

from dataclasses import replace

from clingo import Symbol

from agents.intentional.controller import IntentionalRobot
from agents.intentional.reasoners import History, ReferenceReasoner, read_intention
from agents.shared import Intention
from asp.reasoning.diagnosis import Diagnosis, Explanation, diagnosis_of, event_limits
from asp.solving import fact, first_model, ground, optimal_model, theory

_EXPLAINING = ("defaults", "diagnosis")
_INACTIVE = ("finishes", "starts")
_UNDIVIDED = (*_EXPLAINING, "planning", "joint", "undivided")
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
        texts = [*self._base, *map(theory, _UNDIVIDED)]
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


def _found(intention: Intention | None) -> Intention:
    assert intention is not None, "(53): an agent always has an intention"
    return intention


class Joint(IntentionalRobot):
    """TI: all smallest explanations are considered while planning."""

    _make_reasoner = JointReasoner


class JointReference(IntentionalRobot):
    """TI to the letter, in one program."""

    _make_reasoner = JointReferenceReasoner
