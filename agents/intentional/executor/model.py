"""What is made once of a refinement: its planner, its inferences, and what its laws say.

Laws of D_f are read instance by instance, when asked for.
"""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterable
from itertools import chain

from asp.language import (
    Facts,
    Literal,
    Pattern,
    closed_world,
    functions,
    pattern_of,
    subject,
    syntax,
)
from asp.language import variable_sorts as roles
from asp.reasoning.fine_knowledge import IncrementalFineKnowledge
from asp.reasoning.fine_planning import fine_planner
from asp.refinement import Refinement, sensing_of, shared_places
from asp.solving import Recent, preparation

MOST_REFINEMENTS = 16
"""Of how many refinements this is kept: those that were used last."""


class Effects:
    """The direct effects of concrete actions and of events."""

    def __init__(self, refinement: Refinement) -> None:
        signature = refinement.weak_signature
        statics = closed_world(refinement.statics, signature)
        self._laws: dict[str, list[Pattern]] = defaultdict(list)
        for law in refinement.weak.each(syntax.CausalLaw):
            given = law.action.args
            pattern = pattern_of(law, signature, statics, given, law.head)
            self._laws[law.action.name].append(pattern)

    def of(self, action: str, true: Iterable[str]) -> tuple[Literal, ...]:
        """The literals that the action brings about where these fluents are known to be true."""
        one, facts = Literal.parse(action), Facts(map(Literal.parse, true))
        heads = (law.heads(one.arguments, facts) for law in self._laws.get(one.name, ()))
        return tuple(dict.fromkeys(chain.from_iterable(heads)))


class FineModel:
    """Planner, inferences and laws of one refinement.

    `shares_places` says whether the components of anything are always in the same place;
    `unmagnified` are the inertial fluents without counterparts, and `carriers` those of them that
    constraints on fine fluents depend on. Of each coarse action, `conditions` are the fluents on
    which it depends whether it is possible, and `direct_effects` what causal laws say that it may
    bring about.
    """

    def __init__(self, refinement: Refinement) -> None:
        weak, magnified = refinement.weak, refinement.counterparts
        self.planner = fine_planner(weak, refinement.weak_signature)
        self.knowledge = IncrementalFineKnowledge(refinement)
        self.sensing = sensing_of(refinement)
        self.effects = Effects(refinement)
        self.shares_places = bool(shared_places(weak))
        self.unmagnified = frozenset(
            fluent for fluent in refinement.description.inertial if fluent.name not in magnified
        )
        fine = frozenset(magnified.values())
        named = {
            literal.atom.name
            for law in weak.each(syntax.StateConstraint)
            if law.head.atom.name in fine
            for literal in roles.literals(law.body)
        }
        self.carriers = frozenset(fluent for fluent in self.unmagnified if fluent.name in named)
        self.conditions: dict[str, frozenset[str]] = {}
        for law in refinement.description.executability:
            for action in law.actions:
                before = self.conditions.get(action, frozenset())
                self.conditions[action] = before.union(each.atom for each in law.body)
        self.direct_effects: dict[str, frozenset[str]] = {}
        for causal in refinement.description.causal:
            found = self.direct_effects.get(causal.action, frozenset())
            self.direct_effects[causal.action] = found | {causal.head}
        self._functions = functions(weak, refinement.weak_signature)

    def is_value(self, fluent: str) -> bool:
        """Whether a fine fluent is one of several of which one always holds."""
        return subject(fluent, self._functions) is not None


_MODELS: Recent[Refinement, FineModel] = Recent(MOST_REFINEMENTS)


def fine_model(refinement: Refinement) -> FineModel:
    """The model of a refinement, made when it is first asked for, as preparation."""
    with preparation():
        return _MODELS.get(refinement, lambda: FineModel(refinement))
