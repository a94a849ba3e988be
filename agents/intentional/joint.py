"""The original theory of intentions (TI): all explanations are considered while planning.

`JointReasoner` is the theory to the letter, one program that is solved in one call;
`StagedJointReasoner` is held equal to it.
"""

from dataclasses import replace

from clingo import Symbol

from agents.intentional.activities import History
from agents.intentional.controller import IntentionalRobot
from agents.intentional.reasoners import ReferenceReasoner, read_intention
from agents.shared import Intention
from asp.reasoning.diagnosis import Diagnosis, Explanation, diagnosis_of, event_limits
from asp.solving import fact, first_model, ground, optimal_model, theory

_EXPLAINING = ("defaults", "diagnosis")
_INACTIVE = ("finishes", "starts")
_UNDIVIDED = (*_EXPLAINING, "planning", "joint", "undivided")
_ACTIVE = ("goes_on", "finishes", "stops")


class JointReasoner(ReferenceReasoner):
    """Finds explanation and intention together, in one program.

    Nothing is known beforehand, neither how few events explain the history nor how long a shortest
    plan is, and the horizon lets a plan be as long as the limit: for small domains only.
    """

    def diagnose(self, _history: History, adopted: Explanation, /) -> Diagnosis:
        """What was held before, of which nothing is proved: there is no phase of its own."""
        return Diagnosis(replace(adopted, proved=False))

    def intend(self, history: History, diagnosis: Diagnosis, /) -> Intention:
        """The intention for which CR rules are used least. Raises InconsistentHistoryError."""
        facts = [*self._facts(history), fact("explaining", history.step)]
        texts = [*self._base, *map(theory, _UNDIVIDED)]
        longest = max(self._plan_limit, history.longest)
        constants = self._constants(history, history.step + 1 + longest, longest)
        constants["plan_limit"] = self._plan_limit

        def best(most: int) -> Intention | None:
            counting = {**constants, "max_unobserved": most}
            model, proved = optimal_model(ground(texts, counting, facts))
            if model is None:
                return None
            return replace(read_intention(model), under=diagnosis_of(model, proved))

        limits = event_limits(self._base[0], facts, history.step, diagnosis.explanation.size)
        return next(filter(None, map(best, limits)))


class StagedJointReasoner(ReferenceReasoner):
    """The same in two stages, so that larger programs are solved.

    Phase one finds how few events and exceptions explain the history, phase two the intention, in
    one program with every explanation that takes no more of them; plans of one action are tried
    before plans of two.
    """

    def diagnose(self, history: History, adopted: Explanation, /) -> Diagnosis:
        """The first of all smallest explanations; none is kept. Raises InconsistentHistoryError."""
        return self._diagnose(history, adopted, keeps=False)

    def _lengths(self, history: History, diagnosis: Diagnosis) -> range:
        if not diagnosis.indices:
            return super()._lengths(history, diagnosis)
        # Under another explanation more of the plan may be left than under the first one.
        whole = max(len(history.activities[name - 1].plan) for name in diagnosis.indices)
        return range(whole, whole + 1)

    def _intention(
        self, history: History, diagnosis: Diagnosis, length: int, more: tuple[Symbol, ...]
    ) -> Intention | None:
        """The intention that is best under any smallest explanation; its `under` says which.

        An activity that may still succeed is gone on with, and one that cannot is stopped. Without
        one the agent finishes if the goal may hold, else it starts the plan that may reach it. Of
        the explanation only the numbers of events and exceptions count.
        """
        explanation = diagnosis.explanation
        constants = self._constants(history, history.step + 1 + length, length)
        most = explanation.size
        texts = [theory(name) for name in (*_EXPLAINING, "planning", "joint")]
        facts = [*self._facts(history), fact("explaining", history.step), *more]
        control = ground([*self._base, *texts], {**constants, "max_unobserved": most}, facts)
        smallest = [
            (fact("number_unobserved", most, history.step), True),
            (fact("number_exceptions", len(explanation.exceptions)), True),
        ]
        for kind in _ACTIVE if diagnosis.indices else _INACTIVE:
            model = first_model(control, [*smallest, (fact(kind), True)])
            if model is not None:
                under = diagnosis_of(model, explanation.proved)
                return replace(read_intention(model), under=under)
        return None


_ABLE = replace(IntentionalRobot.capabilities, plans=("optimistic",))


class Joint(IntentionalRobot):
    """TI: explanation and intention are found together, in one program."""

    capabilities = _ABLE
    _make_reasoner = JointReasoner


class StagedJoint(IntentionalRobot):
    """TI in two stages: all smallest explanations are considered while planning."""

    capabilities = _ABLE
    _make_reasoner = StagedJointReasoner
