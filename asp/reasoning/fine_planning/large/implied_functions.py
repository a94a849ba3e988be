"""Which functions follow others: as the place of what is held the place of who holds it."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence

from asp.reasoning.fine_planning.large.relaxed_rules import Graph


def implied(
    values: Mapping[int, Sequence[int]], functions: Mapping[int, int], graph: Graph
) -> dict[int, list[int]]:
    """Functions, by number, with all the values that they can have as far as others have those.

    `values` are the nodes left of the values of functions, one of which each is sure to have;
    `functions` has for each node that gives a function a value the number of that function.
    """
    groups = [list(_groups(nodes, graph)) for nodes in values.values()]
    certain = {node for group in groups if len(group) == 1 for node in group[0]}
    found: dict[int, list[int]] = {}
    for group in groups:
        images = [_images(nodes, certain, functions, graph) for nodes in group]
        if images:
            for number in set(images[0]).intersection(*images[1:]) - values.keys():
                found[number] = [node for image in images for node in image[number]]
    return found


def _groups(nodes: Iterable[int], graph: Graph) -> Iterator[set[int]]:
    """What is always true together is one value."""
    seen: set[int] = set()
    for node in nodes:
        if node not in seen:
            together = graph.same(node)
            seen |= together
            yield together


def _images(
    nodes: Iterable[int], certain: set[int], functions: Mapping[int, int], graph: Graph
) -> dict[int, set[int]]:
    """The values, by function, that are sure where a value is had and what is certain is true."""
    found: dict[int, set[int]] = {}
    for node in nodes:
        for others, head in graph.implied.get(node, ()):
            if certain.issuperset(others) and head in functions:
                found.setdefault(functions[head], set()).update(graph.same(head))
    return found
