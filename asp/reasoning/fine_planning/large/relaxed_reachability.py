"""What a compact program can reach if nothing that was ever true became false again.

No plan is shorter than it takes to reach every literal of its goal by itself in this way; and where
one is not reached, no plan does. The nodes are the atoms of one step of the ground program, its
rules are read as Horn clauses: the conditions that something is absent are left out, and so are the
constraints.
"""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Collection, Iterable, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from itertools import chain

import clingo
from clingo import Number

from asp.language import is_positive
from asp.solving import preparation, theory

Body = tuple[int, ...]


class Clauses(clingo.Observer):
    """Collects heads and positive bodies; what is counted in a body is taken to be so.

    What is chosen without a condition is the start. `sure` are bodies of one or two atoms that no
    more is needed with, and their heads.
    """

    def __init__(self) -> None:
        self.clauses: list[tuple[Sequence[int], list[int]]] = []
        self.sure: set[tuple[Body, int]] = set()

    def rule(self, choice: bool, head: Sequence[int], body: Sequence[int]) -> None:
        if head and (body or not choice):
            self.clauses.append((list(head), [literal for literal in body if literal > 0]))
            if len(head) == 1 and len(body) in (1, 2) and min(body) > 0 and not choice:
                self.sure.add((tuple(body), head[0]))

    def weight_rule(
        self,
        choice: bool,  # noqa: ARG002 (clingo's names)
        head: Sequence[int],
        lower_bound: int,  # noqa: ARG002
        body: Sequence[tuple[int, int]],  # noqa: ARG002
    ) -> None:
        if head:
            self.clauses.append((list(head), []))


class Graph:
    """Nodes are atoms; what is true after a step is true before the next, at the cost of one.

    Clauses with one condition are followed beforehand: `light` has for each node all that follows
    from it alone, as far as it matters. `following` leads from what is true after a step to the
    same before the next, `earlier` back.
    """

    def __init__(
        self,
        clauses: Clauses,
        now: dict[str, int],
        later: dict[str, int],
        actions: Collection[int],
    ) -> None:
        self.following = {later[fluent]: now[fluent] for fluent in later if fluent in now}
        self.given = [atom for heads, body in clauses.clauses if not body for atom in heads]
        self.heavy: dict[int, list[int]] = defaultdict(list)
        self.bodies: list[Body] = []
        self.heads: list[Sequence[int]] = []
        single = self._single = defaultdict[int, list[int]](list)
        for heads, body in clauses.clauses:
            conditions = tuple(set(body))
            if len(conditions) == 1:
                single[conditions[0]] += heads
            elif conditions:
                for atom in conditions:
                    self.heavy[atom].append(len(self.heads))
                self.bodies.append(conditions)
                self.heads.append(heads)
        self._sure = clauses.sure
        self._mattering = self.following.keys() | self.heavy.keys() | {*now.values(), *actions}
        self.light = {
            atom: [a for a in _following(atom, single) if a in self._mattering]
            for atom in {*single, *now.values(), *self.given, *chain(*self.heads)}
        }

    @cached_property
    def implied(self) -> Mapping[int, Sequence[tuple[Body, int]]]:
        """For each node what is true with it for sure, and what else that takes: one or no node."""
        found: dict[int, list[tuple[Body, int]]] = defaultdict(list)
        for body, head in self._sure:
            for atom in body:
                found[atom].append((tuple(other for other in body if other != atom), head))
        return found

    def same(self, node: int) -> set[int]:
        """The node with others that are true of each other's truth, and so always together."""
        others = {head for more, head in self.implied.get(node, ()) if not more}
        return {node} | {other for other in others if ((), node) in self.implied.get(other, ())}

    @cached_property
    def earlier(self) -> Mapping[int, int]:
        return {now: later for later, now in self.following.items()}

    @cached_property
    def makers(self) -> Mapping[int, Sequence[Body]]:
        """For each node the bodies that it follows from within a step; () for what is given."""
        found: dict[int, list[Body]] = defaultdict(list)
        sources: list[tuple[Body, Iterable[int]]] = [((), self.given)]
        sources += [((atom,), self._single.get(atom, ())) for atom in self._mattering]
        sources += zip(self.bodies, self.heads, strict=True)
        for body, heads in sources:
            for atom in self._nearest(heads):
                found[atom].append(body)
        return found

    def _nearest(self, heads: Iterable[int]) -> Iterable[int]:
        """What matters of the heads and of what follows from them, up to where something does."""
        seen, agenda = set(heads), [*heads]
        while agenda:
            atom = agenda.pop()
            if atom in self._mattering:
                yield atom
            else:
                new = set(self._single.get(atom, ())) - seen
                seen |= new
                agenda += new


class Spread:
    """What is reached from a start; `level` says for each node reached after how many steps."""

    def __init__(self, graph: Graph, start: Iterable[int]) -> None:
        self.level: dict[int, int] = {}
        self._graph = graph
        self._missing = [len(body) for body in graph.bodies]
        self._agenda = [*graph.given, *start]
        self._steps = 0

    def until(self, wanted: Iterable[int]) -> int | None:
        """After how many steps all that is wanted is reached, each by itself; None: never."""
        goals = set(wanted)
        while not goals <= self.level.keys():
            if not self._agenda:
                return None
            self._advance()
        return max((self.level[goal] for goal in goals), default=0)

    def through(self, level: int) -> None:
        """Goes on until all is known that is reached after so many steps."""
        while self._agenda and self._steps <= level:
            self._advance()

    def _advance(self) -> None:
        """Adds all that follows within this step; what follows a step later comes next."""
        graph, level, missing, steps = self._graph, self.level, self._missing, self._steps
        agenda, later = self._agenda, []
        while agenda:
            for atom in graph.light[agenda.pop()]:
                if atom not in level:
                    level[atom] = steps
                    if atom in graph.following:
                        later.append(graph.following[atom])
                    for clause in graph.heavy.get(atom, ()):
                        missing[clause] -= 1
                        if not missing[clause]:
                            agenda += graph.heads[clause]
        self._agenda = [atom for atom in later if atom not in level]
        self._steps = steps + 1


def _following(atom: int, single: Mapping[int, Sequence[int]]) -> Iterable[int]:
    """The atom and all that follows from it by clauses with one condition."""
    found, agenda = {atom}, [atom]
    while agenda:
        new = [a for a in single.get(agenda.pop(), ()) if a not in found]
        found.update(new)
        agenda += new
    return found


class Relaxed:
    """The Horn clauses of one step of a compact program.

    `nodes` are those of the fluents before the step, `actions` those of the actions in it,
    `inertial` the fluents that a start may have, `facts` what is so at all times: sorts, statics.
    """

    def __init__(self, program: str) -> None:
        with preparation():
            clauses = Clauses()
            control = clingo.Control(["--warn=none", "-c", "n=1"])
            control.register_observer(clauses)
            for text in (program, theory("incremental_fine_planning")):
                control.add("base", [], text)
            control.ground([("base", [])])
            self.facts = [str(each.symbol) for each in control.symbolic_atoms]
            control.ground([("open", [])])
            self.inertial = frozenset(_atoms(control, "holds")[0])
            # What follows from what is true after a step follows before the next, too.
            control.ground([("state", [Number(0)]), ("step", [Number(1)])])
            self.nodes, later = _atoms(control, "holds")
            self.actions, _ = _atoms(control, "occurs")
            self.graph = Graph(clauses, self.nodes, later, self.actions.values())

    def reach(self, possible: Iterable[str], goal: Iterable[str]) -> Reach | None:
        """What can be reached where these fluents may be true; None if not all of the goal can.

        That something is false is taken to be reached. Raises ValueError for what is no inertial
        fluent.
        """
        nodes, possible = self.nodes, frozenset(possible)
        if not possible <= self.inertial:
            raise ValueError(f"no inertial fluent: {min(possible - self.inertial)}")
        positive = [literal for literal in goal if is_positive(literal)]
        if not all(literal in nodes for literal in positive):
            return None
        start = frozenset(nodes[fluent] for fluent in possible)
        wanted = tuple(nodes[literal] for literal in positive)
        spread = Spread(self.graph, start)
        least = spread.until(wanted)
        return None if least is None else Reach(self.graph, start, wanted, spread, least)


@dataclass(frozen=True)
class Reach:
    """What can be reached from a start, and when; no plan is shorter than `least` steps."""

    graph: Graph
    start: frozenset[int]
    wanted: tuple[int, ...]
    spread: Spread
    least: int


def _atoms(control: clingo.Control, predicate: str) -> tuple[dict[str, int], dict[str, int]]:
    """The atoms holds(F,I), or occurs(A,I), by fluent or action, of the steps 0 and 1."""
    found: tuple[dict[str, int], dict[str, int]] = {}, {}
    for each in control.symbolic_atoms.by_signature(predicate, 2):
        what, step = each.symbol.arguments
        found[step.number][str(what)] = each.literal
    return found
