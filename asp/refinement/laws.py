"""The laws of a coarse description at the fine resolution, one coarse law after the other.

A law about attributes and actions with counterparts becomes a law about the counterparts; one
without any stays; a condition that ties an action with a counterpart to an attribute without one
is kept as it is about the coarse attributes, for the fine actions that would bring about what the
coarse action does.
"""

from collections.abc import Iterable, Iterator
from dataclasses import dataclass, replace
from itertools import chain, product

from asp.language import Problems, syntax, text_of
from asp.language import variable_sorts as roles
from asp.refinement.language import Vocabulary
from asp.refinement.renaming import Renaming, effects_of

KEPT = "As in the coarse description; what has a counterpart is a defined fluent here."
REFINED = "About the counterparts of what the coarse law is about."
LIFTED = "Conditions on coarse attributes, for what would bring about the coarse effect."
"""How laws of the refined description came about, as the heading above them says."""

Refined = Iterator[tuple[syntax.Statement, str]]


@dataclass(frozen=True)
class Rewriting:
    """The names, the coarse text, and the places of fluents that components share.

    `problems` are those of the coarse text: laws that cannot be refined are reported there.
    """

    vocabulary: Vocabulary
    coarse: syntax.Source
    shared: frozenset[tuple[str, int]]
    problems: Problems

    def refine(self, law: syntax.Statement) -> Refined:
        """The statements that a coarse one becomes, each with how; none where it falls away.

        Reports a law that cannot be refined.
        """
        renaming = Renaming(law, self.vocabulary)
        match law:
            case syntax.CausalLaw(action=action) if self._concerns(action):
                yield self._causal(law, renaming), REFINED
            case syntax.CausalLaw(action=action, head=head) if self._concerns(head.atom):
                needs = f"which has a counterpart, so that '{action.name}' needs one"
                message = f"'{action.name}' changes '{head.atom.name}', {needs}"
                self.problems.report(law.place, message)
            case syntax.StateConstraint():
                yield from self._constraint(law, renaming)
            case syntax.ExecutabilityCondition(actions=actions) if self._concerns(*actions):
                if renaming.is_about_wholes(law):
                    yield from self._lifted(law)
                else:
                    yield self._condition(law, renaming), REFINED
            case syntax.InitiallyStatement(fluent=fluent) if self._concerns(fluent):
                fluent, variable = renaming.atom(fluent), renaming.fine(law.variable)
                yield replace(law, fluent=fluent, variable=variable), REFINED
            case syntax.SeesStatement(fluent=fluent) | syntax.ShowsStatement(fluent=fluent) if (
                self._concerns(fluent)
            ):
                pass
            case syntax.ShowsStatement(action=action) if self._concerns(action):
                action = renaming.atom(action)
                atoms = (law.fluent, *(part.atom for part in roles.literals(law.body)))
                renaming.note(term for atom in atoms for term in atom.args)
                yield replace(law, action=action, body=(*renaming.links(), *law.body)), REFINED
            case _:
                yield law, KEPT

    def _concerns(self, *atoms: syntax.Atom) -> bool:
        """Whether one of the atoms has a counterpart."""
        return any(atom.name in self.vocabulary.counterparts for atom in atoms)

    def _causal(self, law: syntax.CausalLaw, renaming: Renaming) -> syntax.CausalLaw:
        action, head = renaming.atom(law.action), renaming.literal(law.head)
        body = renaming.body(law.body)
        bound = {term.name for term in action.args}
        if head.positive and self._concerns(law.head.atom):
            free = [t for t in head.atom.args if t.is_variable and t.name not in bound]
            self._check_head(law, free, renaming)
        return replace(law, action=action, head=head, body=(*renaming.links(), *body))

    def _constraint(self, law: syntax.StateConstraint, renaming: Renaming) -> Refined:
        static = self.vocabulary.coarse.symbols[law.head.atom.name].kind == "static"
        concerns = self._concerns(law.head.atom)
        if static or not concerns:
            yield law, KEPT
        if concerns:
            head, body = renaming.literal(law.head), renaming.body(law.body)
            if static and renaming.links():
                return
            if head.positive:
                self._check_head(law, head.atom.args, renaming)
            yield replace(law, head=head, body=(*renaming.links(), *body)), REFINED

    def _check_head(
        self, law: syntax.Statement, terms: Iterable[syntax.Term], renaming: Renaming
    ) -> None:
        """A component that is only known by its whole: the law would hold for all components."""
        tied = {link.atom.args[0].name for link in roles.literals(renaming.links())}
        if any(term.name in tied for term in terms):
            message = "this law does not say for which of the components it holds"
            self.problems.report(law.place, message)

    def _condition(
        self, law: syntax.ExecutabilityCondition, renaming: Renaming
    ) -> syntax.ExecutabilityCondition:
        """The condition about the counterparts of what it is about."""
        actions = tuple(map(renaming.atom, law.actions))
        brought = chain.from_iterable(effects_of(action, self.coarse) for action in law.actions)
        effects = {text_of(head.atom) for head, _ in brought}
        acted = {term.name for action in law.actions for term in action.args}
        body: list[syntax.Condition] = []
        for part in law.body:
            if isinstance(part, syntax.Literal) and text_of(part.atom) not in effects:
                body.append(self._about_any_component(part, acted, renaming))
            else:
                body += renaming.body((part,))
        return replace(law, actions=actions, body=(*body, *renaming.links()))

    def _about_any_component(
        self, part: syntax.Literal, acted: set[str], renaming: Renaming
    ) -> syntax.Literal:
        """A condition on what the action is about: any of its components may meet it.

        Not so where a law of the refinement says that the components share the fluent anyway.
        """
        condition = renaming.literal(part)
        symbol = self.vocabulary.coarse.symbols.get(part.atom.name)
        if not part.positive or symbol is None or symbol.kind not in roles.FLUENTS:
            return condition
        pairs = zip(part.atom.args, condition.atom.args, strict=True)
        terms = tuple(
            renaming.another(whole)
            if renaming.is_magnified(whole)
            and whole.name in acted
            and (condition.atom.name, place) not in self.shared
            else term
            for place, (whole, term) in enumerate(pairs)
        )
        return replace(condition, atom=replace(condition.atom, args=terms))

    def _lifted(self, law: syntax.ExecutabilityCondition) -> Refined:
        """The condition as it is, for the fine actions that would bring about the effects."""
        concerned = filter(self._concerns, law.actions)
        effects = [effects_of(action, self.coarse) for action in concerned]
        given = set(map(text_of, law.body))
        for brought in product(*filter(None, effects)):
            if any(text_of(head) in given for head, _ in brought):
                continue
            changes: list[syntax.Condition] = []
            for head, conditions in brought:
                changes += (replace(head, positive=not head.positive), *conditions)
            body = (*(c for c in changes if text_of(c) not in given), *law.body)
            renaming = Renaming(law, self.vocabulary)
            actions = tuple(
                renaming.atom(action) if self._concerns(action) else action
                for action in law.actions
            )
            renaming.note(term for part in roles.literals(body) for term in part.atom.args)
            yield replace(law, actions=actions, body=(*renaming.links(), *body)), LIFTED
