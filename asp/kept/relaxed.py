"""A lower bound on the length of plans: as if nothing that was ever true became false again.

What a compact program can derive is read as Horn clauses: the conditions that something is absent
are left out, and so are the constraints. No plan is shorter than it takes to reach every literal of
its goal by itself under these; and where they do not reach one, no plan does.
"""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterable, Mapping, Sequence
from itertools import chain

import clingo
from clingo import Number

from asp.kept.clock import standing_still
from asp.literals import is_positive
from asp.solving import theory


class Relaxed:
    """The Horn clauses of one step of a compact program."""

    def __init__(self, program: str) -> None:
        with standing_still():
            clauses = _Clauses()
            control = clingo.Control(["--warn=none", "-c", "n=1"])
            control.register_observer(clauses)
            for text in (program, theory("kept_fine")):
                control.add("base", [], text)
            parts = [("base", []), ("open", []), ("state", [Number(0)]), ("step", [Number(1)])]
            control.ground([*parts, ("state", [Number(1)])])
            self._now = _fluents(control, 0)
            self._graph = _Graph(clauses, self._now, _fluents(control, 1))

    def bound(self, possible: Iterable[str], goal: Iterable[str]) -> int | None:
        """No plan is shorter; None: there is none. `possible` are the fluents that may be true."""
        start = [self._now[fluent] for fluent in possible if fluent in self._now]
        wanted = set()
        for literal in filter(is_positive, goal):
            if literal not in self._now:
                return None
            wanted.add(self._now[literal])
        return self._graph.levels(start, wanted)


class _Clauses(clingo.Observer):
    """Collects heads and positive bodies; what is counted in a body is taken to be so.

    What is chosen without a condition is the start.
    """

    def __init__(self) -> None:
        self.clauses: list[tuple[Sequence[int], list[int]]] = []

    def rule(self, choice: bool, head: Sequence[int], body: Sequence[int]) -> None:
        if head and (body or not choice):
            self.clauses.append((list(head), [literal for literal in body if literal > 0]))

    def weight_rule(
        self,
        choice: bool,  # noqa: ARG002 (clingo's names)
        head: Sequence[int],
        lower_bound: int,  # noqa: ARG002
        body: Sequence[tuple[int, int]],  # noqa: ARG002
    ) -> None:
        if head:
            self.clauses.append((list(head), []))


class _Graph:
    """Nodes are atoms; what is true after a step is true before the next, at the cost of one.

    Clauses with one condition are followed beforehand: `light` has for each node all that follows
    from it alone, as far as it matters.
    """

    def __init__(self, clauses: _Clauses, now: dict[str, int], later: dict[str, int]) -> None:
        self._next = {later[fluent]: now[fluent] for fluent in later if fluent in now}
        self._given = [atom for heads, body in clauses.clauses if not body for atom in heads]
        self._heavy: dict[int, list[int]] = defaultdict(list)
        self._needs: list[int] = []
        self._heads: list[Sequence[int]] = []
        single: dict[int, list[int]] = defaultdict(list)
        for heads, body in clauses.clauses:
            if len(set(body)) == 1:
                single[body[0]] += heads
            elif body:
                for atom in set(body):
                    self._heavy[atom].append(len(self._heads))
                self._needs.append(len(set(body)))
                self._heads.append(heads)
        mattering = self._next.keys() | self._heavy.keys() | set(now.values())
        self._light = {
            atom: [a for a in _following(atom, single) if a in mattering]
            for atom in {*single, *now.values(), *self._given, *chain(*self._heads)}
        }

    def levels(self, start: Iterable[int], wanted: set[int]) -> int | None:
        """After how many steps all that is wanted can be reached, each by itself; None: never."""
        missing, needs = set(wanted), self._needs.copy()
        reached: set[int] = set()
        agenda, level = [*self._given, *start], 0
        while agenda:
            later = self._close(agenda, reached, needs)
            missing -= reached
            if not missing:
                return level
            agenda, level = [atom for atom in later if atom not in reached], level + 1
        return None

    def _close(self, agenda: list[int], reached: set[int], needs: list[int]) -> list[int]:
        """Adds to what is reached all that follows at once; returns what follows a step later."""
        later = []
        while agenda:
            for atom in self._light[agenda.pop()]:
                if atom not in reached:
                    reached.add(atom)
                    if atom in self._next:
                        later.append(self._next[atom])
                    for clause in self._heavy.get(atom, ()):
                        needs[clause] -= 1
                        if not needs[clause]:
                            agenda += self._heads[clause]
        return later


def _following(atom: int, single: Mapping[int, Sequence[int]]) -> Iterable[int]:
    """The atom and all that follows from it by clauses with one condition."""
    found, agenda = {atom}, [atom]
    while agenda:
        new = [a for a in single.get(agenda.pop(), ()) if a not in found]
        found.update(new)
        agenda += new
    return found


def _fluents(control: clingo.Control, step: int) -> dict[str, int]:
    """The atoms holds(F,step) by fluent."""
    return {
        str(found.symbol.arguments[0]): found.literal
        for found in control.symbolic_atoms.by_signature("holds", 2)
        if found.symbol.arguments[1].number == step
    }
