"""The model of a refinement, made once, and the belief by it: the history H_f and its results.

Laws of D_f are read instance by instance, when asked for.
"""

from collections import defaultdict
from collections.abc import Collection, Iterable
from itertools import chain

from asp.language import (
    Action,
    Facts,
    Fluent,
    Literal,
    Pattern,
    closed_world,
    functions,
    pattern_of,
    subject,
    syntax,
)
from asp.language import variable_sorts as roles
from asp.reasoning.fine_knowledge import IncrementalFineKnowledge, Known
from asp.reasoning.fine_planning import fine_planner
from asp.refinement import Refinement, sensing_of, shared_places
from asp.solving import Recent, State, preparation

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

    def of(self, action: Action, true: Iterable[Fluent]) -> tuple[Literal, ...]:
        """The literals that the action brings about where these fluents are known to be true."""
        facts = Facts(true)
        heads = (law.heads(action.arguments, facts) for law in self._laws.get(action.name, ()))
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
        self.refinement = refinement
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
        self.conditions: dict[Action, set[Fluent]] = defaultdict(set)
        for law in refinement.description.executability:
            for action in law.actions:
                self.conditions[action].update(each.atom for each in law.body)
        self.direct_effects: dict[Action, set[Literal]] = defaultdict(set)
        for causal in refinement.description.causal:
            self.direct_effects[causal.action].add(causal.head)
        self._functions = functions(weak, refinement.weak_signature)

    def is_value(self, fluent: Fluent) -> bool:
        """Whether a fine fluent is one of several of which one always holds."""
        return subject(fluent, self._functions) is not None


class FineBelief:
    """What is known of a trial at the fine resolution."""

    def __init__(self, model: FineModel, literals: Iterable[Literal]) -> None:
        """`literals` are known to begin with."""
        self._model = model
        self._knowledge, self._carriers = model.knowledge, model.carriers
        self._carrying: frozenset[Literal] = frozenset()
        self.known = Known()
        self.see(literals)

    def see(self, literals: Iterable[Literal]) -> None:
        """Takes literals for certain that were observed at one moment.

        What was known gives way to them; where that does not suffice, the least is forgotten.
        """
        after = self._knowledge.after(self._with_carriers(), list(literals))
        unmagnified = self._model.unmagnified
        self.known = Known(after.true - unmagnified, after.false - unmagnified)

    def suppose(self, unmagnified: Collection[Literal]) -> None:
        """Goes by these fluents without counterparts: of those that matter here others are false.

        Where a thing is that has no components may follow from what carries it.
        """
        carrying = self._carriers.intersection(unmagnified)
        if carrying != self._carrying:
            self._carrying = carrying
            self.see(())

    def _with_carriers(self) -> Known:
        """What is known, of the fluents without counterparts that it depends on, too."""
        known = self.known
        if not self._carriers:
            return known
        idle = self._carriers - self._carrying
        return Known(known.true | self._carrying, known.false | idle)

    def is_open(self, fluent: Fluent) -> bool:
        """Whether it is not known if a fluent holds."""
        return fluent not in self.known.true and not self.is_false(fluent)

    def is_false(self, fluent: Fluent) -> bool:
        """Whether a fluent is known not to hold."""
        return self._knowledge.is_false(self._with_carriers(), fluent)

    def contradicts(self, literal: Literal) -> bool:
        """Whether the contrary of a literal is known."""
        return self.is_false(literal) if literal.is_positive else literal.atom in self.known.true

    def coarse(self, fluents: Collection[Fluent]) -> frozenset[Literal]:
        """The literals that follow of coarse fluents with counterparts (indirect observation)."""
        return self._knowledge.coarse(self._with_carriers(), fluents)

    def candidates(self, fluent: Fluent) -> tuple[tuple[Fluent, ...], ...]:
        """Groups of fluents one of each of which is true, nobody knows which, if a coarse one is.

        One group for each component that always has a value, as a thing is always somewhere; else
        a single one. None where one is known.
        """
        groups = self._knowledge.groups(fluent)
        if not self._model.is_value(groups[0][0]):
            groups = (tuple(chain(*groups)),)
        if any(not self.known.true.isdisjoint(group) for group in groups):
            return ()
        return tuple(tuple(f for f in group if not self.is_false(f)) for group in groups)

    def adapt(self, before: State, now: State, fluents: Collection[Fluent]) -> None:
        """Forgets what an explanation at the coarse resolution has made doubtful.

        `before` and `now` are the fluents that were expected and that are believed. Of what is now
        believed and was not expected, and of what is nowhere to be any more though it is believed,
        observations to the contrary are old.
        """
        follows = self.coarse(fluents)
        for fluent in fluents:
            literal = fluent if fluent in now else fluent.complement
            changed = (fluent in before) != (fluent in now)
            if literal.complement in follows or (changed and literal not in follows):
                groups = self._model.refinement.counterpart(literal)
                self.known = self.known.without(p.complement for group in groups for p in group)


_MODELS: Recent[Refinement, FineModel] = Recent(MOST_REFINEMENTS)


def fine_model(refinement: Refinement) -> FineModel:
    """The model of a refinement, made when it is first asked for, as preparation."""
    with preparation():
        return _MODELS.get(refinement, lambda: FineModel(refinement))
