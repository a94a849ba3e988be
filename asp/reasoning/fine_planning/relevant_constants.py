"""Which constants a plan can have to do with, so that the others are not even instantiated.

A constant is out of play if nothing that names it can be true on the way, nor an action that names
it occur. What a rule says of such a constant is void where the rule's head names it, or a condition
that has to be true; variables that occur elsewhere only are *loose*, and constants that they may
stand for stay in play.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Mapping, Sequence

from asp.language import arguments
from asp.reasoning.fine_planning.large.function_values import Valued
from asp.reasoning.fine_planning.large.relaxed_reachability import Reach
from asp.reasoning.fine_planning.large.value_pruning import Values
from asp.translation import ACTION, STATE, STEP, Rule

_VARIABLE = re.compile(r"\b[A-Z]\w*")
_SORT = re.compile(r"(\w+)\((\w+)\)")
_DYNAMIC = ("holds(", "occurs(", "allowed(", "2 {")


def loose(rules: Iterable[Rule], sorts: Mapping[str, Sequence[str]]) -> frozenset[str]:
    """The constants that rules name, or that a loose variable of a rule may stand for."""
    found: set[str] = set()
    for rule in rules:
        found |= rule.constants
        if rule.part in (STATE, STEP):
            found.update(*(sorts[sort] for sort in _loose_sorts(rule, sorts)))
    return frozenset(found)


def _loose_sorts(rule: Rule, sorts: Mapping[str, Sequence[str]]) -> Iterator[str]:
    tied = set(_VARIABLE.findall(rule.head))
    for condition in rule.body:
        if condition.startswith(_DYNAMIC):
            tied.update(_VARIABLE.findall(condition))
    for condition in rule.body:
        match = _SORT.fullmatch(condition)
        if match and match[1] in sorts and match[2] not in tied:
            yield match[1]


def in_play(reach: Reach, known: Valued, steps: Sequence[Values]) -> frozenset[str]:
    """The constants of what may be true, or may occur, at some step, as functions are confined."""
    free = {
        number
        for number, terms in enumerate(known.terms)
        if any(number not in step for step in (steps[:-1] if ACTION in terms else steps))
    }
    left = {node for step in steps for nodes in step.values() for node in nodes}
    return frozenset(
        constant
        for node, level in reach.spread.level.items()
        if level < len(steps) and node in known.text
        if node in left or known.number.get(node) in (None, *free)
        for constant in arguments(known.text[node])
    )
