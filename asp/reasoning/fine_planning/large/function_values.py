"""The functions of a compact program as sets of nodes, numbered; what is always equal is one."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from asp.language import Function, arguments, ground, name
from asp.reasoning.fine_planning.large.relaxed_reachability import Relaxed
from asp.translation import ACTION


@dataclass(frozen=True)
class Valued:
    """`number` is, for each node that gives a function a value, the number of the function.

    Functions that by the laws have the same value at all times, as the places of a thing's parts,
    share their number; `terms` are those of each number. `text` is what each node stands for.
    """

    number: Mapping[int, int]
    terms: Sequence[Sequence[str]]
    text: Mapping[int, str]


def valued(relaxed: Relaxed, functions: Mapping[str, Function]) -> Valued:
    """The functions among the fluents of a program, and ACTION."""
    nodes: dict[str, list[int]] = defaultdict(list)
    nodes[ACTION] = [*relaxed.actions.values()]
    fluents = {node: fluent for fluent, node in relaxed.nodes.items()}
    for node, fluent in fluents.items():
        function = functions.get(name(fluent))
        if function is not None:
            others = list(arguments(fluent))
            del others[function.place]
            nodes[ground(name(fluent), others)].append(node)
    classes: dict[frozenset[int], list[str]] = defaultdict(list)
    for term, values in nodes.items():
        classes[frozenset(min(relaxed.graph.same(node)) for node in values)].append(term)
    numbered = enumerate(classes.values())
    numbers = {node: number for number, terms in numbered for term in terms for node in nodes[term]}
    actions = {node: action for action, node in relaxed.actions.items()}
    return Valued(numbers, [*classes.values()], fluents | actions)
