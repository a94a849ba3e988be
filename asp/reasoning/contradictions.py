"""Which actions may contradict a state constraint, by the form of the laws."""

from collections import defaultdict
from collections.abc import Iterable, Mapping

from asp.language import Action, Description, Literal
from asp.reasoning.determinism import deterministic_by_form

_Heads = Mapping[Literal, Iterable[Literal]]


def suspects(description: Description) -> list[Action]:
    """The agent's actions of which the form of the laws does not show that they contradict none.

    It is sound: an action that is left out has a successor wherever no law says that it is
    impossible. Of two literals that contradict each other in what follows at least one is new; the
    other one needs a law whose conditions can hold beside it. A condition that is not new is kept
    from the state before, and cannot be where its complement follows from the new literal, or from
    effects without conditions, by constraints with one condition each.
    """
    if not deterministic_by_form(description):
        return list(description.agent_actions)
    following, alone = (
        defaultdict[Literal, list[Literal]](list),
        defaultdict[Literal, set[Literal]](set),
    )
    bodies = defaultdict[Literal, list[tuple[Literal, ...]]](list)
    for law in description.constraints:
        bodies[law.head].append(law.body)
        for literal in law.body:
            following[literal].append(law.head)
            if len(law.body) == 1:
                alone[literal].add(law.head)
    effects, certain_effects = (
        defaultdict[Action, set[Literal]](set),
        defaultdict[Action, set[Literal]](set),
    )
    for causal in description.causal:
        effects[causal.action].add(causal.head)
        if not causal.body:
            certain_effects[causal.action].add(causal.head)
    defined = frozenset(description.defined)
    lost = {fluent.complement for fluent in defined}

    def is_suspect(action: Action) -> bool:
        new = _closure(effects[action] | lost, following)
        certain = _closure(certain_effects[action], alone)

        def may_hold(condition: Literal, beside: Literal) -> bool:
            excluded = condition.complement in certain or condition.complement in alone[beside]
            return condition in new or condition.atom in defined or not excluded

        return any(
            literal.complement in effects[action]
            or any(
                all(may_hold(c, literal) for c in body)
                for body in bodies.get(literal.complement, ())
            )
            for literal in new
            if literal in bodies or literal in effects[action]  # not by the closed world alone
        )

    return [action for action in description.agent_actions if is_suspect(action)]


def _closure(literals: Iterable[Literal], following: _Heads) -> set[Literal]:
    """The literals, and all that may follow from one of them, one after the other."""
    found = set(literals)
    waiting = list(found)
    while waiting:
        heads = [head for head in following.get(waiting.pop(), ()) if head not in found]
        found.update(heads)
        waiting += heads
    return found
