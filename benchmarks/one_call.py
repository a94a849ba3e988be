"""ATI whose plan is found as TI finds it."""

from agents.intentional.activities import History
from agents.intentional.reasoners import ReferenceReasoner, read_intention
from agents.shared import Intention
from asp.reasoning.diagnosis import Diagnosis
from asp.solving import fact, ground, optimal_model, theory


class OneCallReasoner(ReferenceReasoner):
    """Plans in one call, with a horizon for the longest plan, but under one explanation."""

    def intend(self, history: History, explained: Diagnosis) -> Intention:
        horizon = history.step + 1 + self._plan_limit
        constants = self._constants(history, horizon, self._plan_limit)
        constants["plan_limit"] = self._plan_limit
        adopted = explained.explanation
        facts = [*self._facts(history), *adopted.facts("explained")]
        facts.append(fact("explanation", len(adopted.unobserved), history.step))
        texts = [*self._base, *map(theory, ("planning", "joint", "undivided"))]
        model, _ = optimal_model(ground(texts, constants, facts))
        assert model is not None
        return read_intention(model)
