"""Literals that a compact program reaches if no atom that was ever true becomes false again.

No plan is shorter than it takes to reach every literal of its goal by itself in this way; and where
one is not reached, no plan does. The nodes are the atoms of one step of the ground program, its
rules are read as Horn clauses: the conditions that something is absent are left out, and so are the
constraints.
"""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Collection, Iterable, Mapping, Sequence

import clingo
from clingo import Number

from asp.language import Action, Fluent, Literal
from asp.solving import literal_of, preparation, theory

Body = tuple[int, ...]


class Relaxed(clingo.Observer):
    """The Horn clauses of one step of a compact program.

    `nodes` are those of the fluents before the step, `actions` those of the actions in it,
    `inertial` the fluents that a start may have, `facts` what is so at all times: sorts, statics.
    What is true after a step is true before the next: `following` leads from the one to the other,
    `earlier` back. `clauses` are bodies with heads, `uses` the numbers of the clauses that a node
    is in the body of, `makers` the bodies that it is the head of. `implied` says what is true with
    a node for sure, and what else that takes: one node, or none.
    """

    def __init__(self, program: str) -> None:
        self.clauses: list[tuple[Body, Sequence[int]]] = []
        self.uses: Mapping[int, list[int]] = defaultdict(list)
        self.makers: Mapping[int, list[Body]] = defaultdict(list)
        self.implied: Mapping[int, list[tuple[Body, int]]] = defaultdict(list)
        with preparation():
            control = clingo.Control(["--warn=none", "-c", "n=1"])
            control.register_observer(self)
            for text in (program, theory("incremental_fine_planning")):
                control.add("base", [], text)
            control.ground([("base", [])])
            self.facts = [literal_of(each.symbol) for each in control.symbolic_atoms]
            control.ground([("open", [])])
            self.inertial = frozenset(_atoms(control, "holds")[0])
            # What follows from what is true after a step follows before the next, too.
            control.ground([("state", [Number(0)]), ("step", [Number(1)])])
            self.nodes, later = _atoms(control, "holds")
            self.actions, _ = _atoms(control, "occurs")
        both = later.keys() & self.nodes.keys()
        self.following = {later[fluent]: self.nodes[fluent] for fluent in both}
        self.earlier = {now: after for after, now in self.following.items()}

    def rule(self, choice: bool, head: Sequence[int], body: Sequence[int]) -> None:
        """A rule is read as its head and positive body; what is chosen without a condition is not.

        That is the start.
        """
        if not head or (choice and not body):
            return
        self._add(head, [literal for literal in body if literal > 0])
        if len(head) == 1 and len(body) in (1, 2) and min(body) > 0 and not choice:
            for node in body:
                self.implied[node].append((tuple(n for n in body if n != node), head[0]))

    def weight_rule(self, _choice: bool, head: Sequence[int], *_body: object) -> None:
        """What is counted in a body is taken to be so."""
        if head:
            self._add(head, ())

    def _add(self, heads: Sequence[int], body: Iterable[int]) -> None:
        conditions = tuple(set(body))
        for node in conditions:
            self.uses[node].append(len(self.clauses))
        for node in heads:
            self.makers[node].append(conditions)
        self.clauses.append((conditions, list(heads)))

    def same(self, node: int) -> set[int]:
        """The node with others that are true of each other's truth, and so always together."""
        others = {head for more, head in self.implied.get(node, ()) if not more}
        return {node} | {other for other in others if ((), node) in self.implied.get(other, ())}

    def reach(self, possible: Iterable[Action], goal: Iterable[Literal]) -> Reach | None:
        """What can be reached where these fluents may be true; None if not all of the goal can.

        That something is false is taken to be reached. Raises ValueError for what is no inertial
        fluent.
        """
        nodes, possible = self.nodes, frozenset(possible)
        if not possible <= self.inertial:
            raise ValueError(f"no inertial fluent: {min(possible - self.inertial)}")
        positive = [literal for literal in goal if literal.is_positive]
        if not all(literal in nodes for literal in positive):
            return None
        reach = Reach(self, [nodes[f] for f in possible], [nodes[literal] for literal in positive])
        return reach if reach.level.keys() >= set(reach.wanted) else None


class Reach:
    """What can be reached from a start, until all that is wanted is, each node by itself.

    `level` says for each node reached after how many steps; no plan is shorter than `least` steps.
    """

    def __init__(self, relaxed: Relaxed, start: Collection[int], wanted: Sequence[int]) -> None:
        self.relaxed = relaxed
        self.start = start
        self.wanted = wanted
        self.level: dict[int, int] = {}
        self._missing = [len(body) for body, _ in relaxed.clauses]
        self._agenda = [node for body, heads in relaxed.clauses if not body for node in heads]
        self._agenda += start
        self._steps = 0
        while self._agenda and not self.level.keys() >= set(wanted):
            self._advance()
        self.least = max((self.level.get(goal, 0) for goal in wanted), default=0)

    def through(self, level: int) -> None:
        """Goes on until all is known that is reached after so many steps."""
        while self._agenda and self._steps <= level:
            self._advance()

    def _advance(self) -> None:
        """Adds all that follows within this step; what follows a step later comes next."""
        relaxed, level, missing, steps = self.relaxed, self.level, self._missing, self._steps
        agenda, later = self._agenda, []
        while agenda:
            node = agenda.pop()
            if node not in level:
                level[node] = steps
                if node in relaxed.following:
                    later.append(relaxed.following[node])
                for clause in relaxed.uses.get(node, ()):
                    missing[clause] -= 1
                    if not missing[clause]:
                        agenda += relaxed.clauses[clause][1]
        self._agenda = [node for node in later if node not in level]
        self._steps = steps + 1


def _atoms(control: clingo.Control, predicate: str) -> tuple[dict[Fluent, int], dict[Fluent, int]]:
    """The atoms holds(F,I), or occurs(A,I), by fluent or action, of the steps 0 and 1."""
    found: tuple[dict[Fluent, int], dict[Fluent, int]] = {}, {}
    for each in control.symbolic_atoms.by_signature(predicate, 2):
        what, step = each.symbol.arguments
        found[step.number][literal_of(what)] = each.literal
    return found
