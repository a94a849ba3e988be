"""Which values functions must have on the way of a plan of a given length.

Read as Horn clauses (`asp.reasoning.fine_planning.large.relaxed_rules`), what leads to a literal of
the goal is a graph of atoms at steps. A function is a *landmark* at a step where every derivation
of the literal has one of its values at that step. Every plan is such a derivation, of what is true
on its way; and a function has one value at a time. So at that step it has a value of which
something leads to the goal, and all others can be left out of the search: no plan of this length is
lost.
"""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Mapping

from asp.reasoning.fine_planning.large.implied_functions import implied
from asp.reasoning.fine_planning.large.landmarks import Layer, landmarks
from asp.reasoning.fine_planning.large.relaxed_reachability import Reach
from asp.reasoning.fine_planning.large.relaxed_rules import Body

Values = dict[int, list[int]]
"""The functions that are confined at a step, by number, each with the nodes of the values left."""

_MOST_NODES = (500, 5_000, 50_000)  # what more nodes lead to confines little, for what it takes


def confined(reach: Reach, functions: Mapping[int, int], length: int) -> list[Values]:
    """Which functions are confined, step by step, in plans of a length of at least `reach.least`.

    `functions` has for each node that gives a function a value the number of that function. Of the
    goal's literals those that few nodes lead to come first: what they leave out leads nowhere else.
    """
    reach.spread.through(length)
    ways = _Ways(reach, functions, length)
    left = list(reach.wanted)
    for most in _MOST_NODES:
        left = [goal for goal in left if not ways.confine(goal, most)]
    return ways.values


class _Ways:
    """Of each step the values left of the functions that are confined there."""

    def __init__(self, reach: Reach, functions: Mapping[int, int], length: int) -> None:
        self.values: list[Values] = [{} for _ in range(length + 1)]
        self._nodes: dict[int, set[int]] = defaultdict(set)
        for node, number in functions.items():
            self._nodes[number].add(node)
        self._reach = reach
        self._functions = functions
        self._length = length
        self._impossible: list[set[int]] = [set() for _ in range(length + 1)]

    def confine(self, goal: int, most: int) -> bool:
        """Confines what are landmarks of a literal; False if more than `most` nodes lead to it."""
        layers = self._layers(goal, most)
        if layers is None:
            return False
        for step, found in enumerate(landmarks(self._reach, goal, self._functions, layers)):
            self.values[step] |= dict(found)
            self.values[step] |= implied(self.values[step], self._functions, self._reach.graph)
            self._leave_out(step)
        return True

    def _leave_out(self, step: int) -> None:
        """Other values of what is confined are impossible, before the step and after the last."""
        others: set[int] = set()
        for number, left in self.values[step].items():
            others.update(self._nodes[number].difference(left))
        self._impossible[step] |= others
        if step:
            earlier = self._reach.graph.earlier
            self._impossible[step - 1].update(earlier[n] for n in others if n in earlier)

    def _layers(self, goal: int, most: int) -> list[Layer] | None:
        """What leads to a literal, step by step backwards."""
        layers: list[Layer] = []
        agenda, left = [goal], most
        for step in range(self._length, -1, -1):
            layer = self._layer(agenda, step, left)
            left -= len(layer)
            if left < 0:
                return None
            layers.append(layer)
            before = map(self._reach.graph.earlier.get, layer)
            agenda = [node for node in before if node is not None and self._holds(node, step - 1)]
        return layers[::-1]

    def _layer(self, agenda: list[int], step: int, most: int) -> Layer:
        """What leads to some nodes within a step, cut off where it is too much."""
        layer: dict[int, list[Body]] = {}
        makers = self._reach.graph.makers
        while agenda and len(layer) <= most:
            node = agenda.pop()
            if node not in layer:
                layer[node] = [
                    body
                    for body in makers.get(node, ())
                    if all(self._holds(atom, step) for atom in body)
                ]
                agenda += [atom for body in layer[node] for atom in body]
        return layer

    def _holds(self, node: int, step: int) -> bool:
        """Whether it may be true at a step."""
        level = self._reach.spread.level.get(node)
        return level is not None and level <= step and node not in self._impossible[step]
