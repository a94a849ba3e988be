"""Landmarks: what every derivation of a literal of the goal has at some step.

Propagated as by L. Zhu and R. Givan, Landmark extraction via planning graph propagation (2003), but
of functions instead of atoms: it is a landmark that a function has one of some values.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from functools import reduce
from operator import or_
from typing import NamedTuple

from asp.reasoning.fine_planning.large.relaxed_reachability import Body, Reach

Layer = Mapping[int, Sequence[Body]]
"""Nodes that lead to the goal at a step, with the bodies that they may follow from within it."""


class Landmark(NamedTuple):
    """A function, by its number, with the nodes of the values that lead to the goal at a step."""

    function: int
    values: list[int]


def landmarks(
    reach: Reach, goal: int, functions: Mapping[int, int], layers: Sequence[Layer]
) -> Iterator[list[Landmark]]:
    """For each step the landmarks there of the goal, a node.

    `functions` has for each node that gives a function a value the number of that function.
    """
    width = len(layers)
    numbers = set(functions.values())
    underivable = 1 << (max(numbers, default=0) + 1) * width
    labels = _all_labels(reach, functions, layers, 2 * underivable - 1)
    label = labels[-1][goal]
    for step in range(width):
        left: dict[int, list[int]] = {n: [] for n in numbers if label >> (n * width + step) & 1}
        for node, own in labels[step].items():
            if functions.get(node) in left and own < underivable:
                left[functions[node]].append(node)
        yield [Landmark(number, values) for number, values in left.items()]


def _all_labels(
    reach: Reach, functions: Mapping[int, int], layers: Sequence[Layer], everything: int
) -> list[dict[int, int]]:
    """For each step the labels of the nodes that lead to the goal.

    A label has a bit for each function and step, set if all that leads to the node has a value of
    it, and a last one that is left to what nothing leads to.
    """
    width, following = len(layers), reach.graph.following
    found: list[dict[int, int]] = []
    known = dict.fromkeys(reach.start, 0)
    for step, layer in enumerate(layers):
        own = {n: 1 << functions[n] * width + step for n in layer if n in functions}
        labels = _labels(layer, own, known, everything)
        known = {following[n]: label for n, label in labels.items() if n in following}
        found.append(labels)
    return found


def _labels(
    layer: Layer, own: Mapping[int, int], known: Mapping[int, int], everything: int
) -> dict[int, int]:
    """The greatest labels that are consistent: what all ways to a node share, and its own.

    `known` are those of what the step before, or the start, makes true.
    """
    labels = dict.fromkeys(layer, everything)
    order = [*layer][::-1]  # mostly causes before effects, as they were found backwards
    changed = True
    while changed:
        changed = False
        for node in order:
            label = known.get(node, everything)
            for body in layer[node]:
                label &= _union(labels[atom] for atom in body)
            label |= own.get(node, 0)
            if label != labels[node]:
                labels[node], changed = label, True
    return labels


def _union(labels: Iterable[int]) -> int:
    return reduce(or_, labels, 0)
