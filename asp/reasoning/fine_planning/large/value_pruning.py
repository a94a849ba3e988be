"""Which values functions must have on the way of a plan of a given length.

Read as Horn clauses (`asp.reasoning.fine_planning.large.relaxed_reachability`), what leads to a
literal of the goal is a graph of atoms at steps. A function is a *landmark* at a step where every
derivation of the literal has one of its values at that step. Every plan is such a derivation, of
what is true on its way; and a function has one value at a time. So at that step it has a value of
which something leads to the goal, and all others can be left out of the search: no plan of this
length is lost.

Landmarks are propagated as by L. Zhu and R. Givan, Landmark extraction via planning graph
propagation (2003), but of functions instead of atoms.
"""

from collections import defaultdict
from collections.abc import Iterable, Iterator, Mapping, Sequence
from functools import reduce
from operator import or_

from asp.language import Function, Literal
from asp.reasoning.fine_planning.large.relaxed_reachability import Body, Reach, Relaxed
from asp.translation import ACTION

Values = dict[int, list[int]]
"""The functions that are confined at a step, by number, each with the nodes of the values left."""

Layer = Mapping[int, Sequence[Body]]
"""Nodes that lead to the goal at a step, with the bodies that they may follow from within it."""

_MOST_NODES = (500, 5_000, 50_000)  # what more nodes lead to confines little, for what it takes


def confined(reach: Reach, functions: Mapping[int, int], length: int) -> list[Values]:
    """Which functions are confined, step by step, in plans of a length of at least `reach.least`.

    `functions` maps each node that states the value of a function to the number of that function.
    Of the goal's literals those that few nodes lead to come first: what they leave out leads
    nowhere else.
    """
    reach.through(length)
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
        for step, found in enumerate(self._landmarks(goal, layers)):
            self.values[step] |= found
            self.values[step] |= self._implied(self.values[step])
            self._leave_out(step)
        return True

    def _leave_out(self, step: int) -> None:
        """Other values of what is confined are impossible, before the step and after the last."""
        others: set[int] = set()
        for number, left in self.values[step].items():
            others.update(self._nodes[number].difference(left))
        self._impossible[step] |= others
        if step:
            earlier = self._reach.relaxed.earlier
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
            before = map(self._reach.relaxed.earlier.get, layer)
            agenda = [node for node in before if node is not None and self._holds(node, step - 1)]
        return layers[::-1]

    def _layer(self, agenda: list[int], step: int, most: int) -> Layer:
        """What leads to some nodes within a step, cut off where it is too much."""
        layer: dict[int, list[Body]] = {}
        makers = self._reach.relaxed.makers
        while agenda and len(layer) <= most:
            node = agenda.pop()
            if node not in layer:
                bodies = makers.get(node, ())
                layer[node] = [b for b in bodies if all(self._holds(atom, step) for atom in b)]
                agenda += [atom for body in layer[node] for atom in body]
        return layer

    def _holds(self, node: int, step: int) -> bool:
        """Whether it may be true at a step."""
        level = self._reach.level.get(node)
        return level is not None and level <= step and node not in self._impossible[step]

    def _landmarks(self, goal: int, layers: Sequence[Layer]) -> Iterator[Values]:
        """For each step the landmarks there of a literal, each with the values that lead to it."""
        width = len(layers)
        numbers = set(self._functions.values())
        underivable = 1 << (max(numbers, default=0) + 1) * width
        labels = self._labels(layers, 2 * underivable - 1)
        label = labels[-1][goal]
        for step in range(width):
            left: Values = {n: [] for n in numbers if label >> (n * width + step) & 1}
            for node, own in labels[step].items():
                if self._functions.get(node) in left and own < underivable:
                    left[self._functions[node]].append(node)
            yield left

    def _labels(self, layers: Sequence[Layer], everything: int) -> list[dict[int, int]]:
        """For each step the labels of the nodes that lead to the goal.

        A label has a bit for each function and step, set if all that leads to the node has a value
        of it, and a last one that is left to what nothing leads to.
        """
        width, following, functions = len(layers), self._reach.relaxed.following, self._functions
        found: list[dict[int, int]] = []
        known = dict.fromkeys(self._reach.start, 0)
        for step, layer in enumerate(layers):
            own = {n: 1 << functions[n] * width + step for n in layer if n in functions}
            labels = _greatest_labels(layer, own, known, everything)
            known = {following[n]: label for n, label in labels.items() if n in following}
            found.append(labels)
        return found

    def _implied(self, values: Values) -> Values:
        """Functions with all the values that they can have as far as others have theirs.

        `values` are the nodes left of the values of functions, one of which each is sure to have.
        """
        groups = [list(self._groups(nodes)) for nodes in values.values()]
        certain = {node for group in groups if len(group) == 1 for node in group[0]}
        found: Values = {}
        for group in groups:
            images = [self._images(nodes, certain) for nodes in group]
            if images:
                for number in set(images[0]).intersection(*images[1:]) - values.keys():
                    found[number] = [node for image in images for node in image[number]]
        return found

    def _groups(self, nodes: Iterable[int]) -> Iterator[set[int]]:
        """What is always true together is one value."""
        seen: set[int] = set()
        for node in nodes:
            if node not in seen:
                together = self._reach.relaxed.same(node)
                seen |= together
                yield together

    def _images(self, nodes: Iterable[int], certain: set[int]) -> dict[int, set[int]]:
        """The values, by function, that are sure where a value is had and what is certain holds."""
        relaxed, functions = self._reach.relaxed, self._functions
        found: dict[int, set[int]] = {}
        for node in nodes:
            for others, head in relaxed.implied.get(node, ()):
                if certain.issuperset(others) and head in functions:
                    found.setdefault(functions[head], set()).update(relaxed.same(head))
        return found


def _greatest_labels(
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
                label &= reduce(or_, (labels[atom] for atom in body), 0)
            label |= own.get(node, 0)
            if label != labels[node]:
                labels[node], changed = label, True
    return labels


class Functions:
    """The functions among the fluents of a program, and ACTION.

    `number` maps each node that states the value of a function to the number of the function.
    Functions that by the laws have the same value at all times, as the places of a thing's parts,
    share their number; `terms` are those of each number. `text` is what each node stands for.
    """

    def __init__(self, relaxed: Relaxed, functions: Mapping[str, Function]) -> None:
        nodes: dict[Literal, list[int]] = defaultdict(list)
        nodes[ACTION] = [*relaxed.actions.values()]
        for fluent, node in relaxed.nodes.items():
            function = functions.get(fluent.name)
            if function is not None:
                nodes[Literal.of(fluent.name, function.others(fluent.arguments))].append(node)
        classes: dict[frozenset[int], list[Literal]] = defaultdict(list)
        for term, values in nodes.items():
            classes[frozenset(min(relaxed.same(node)) for node in values)].append(term)
        self.terms = [*classes.values()]
        self.number = {
            node: number
            for number, terms in enumerate(self.terms)
            for term in terms
            for node in nodes[term]
        }
        self.text = {node: text for text, node in (relaxed.nodes | relaxed.actions).items()}
