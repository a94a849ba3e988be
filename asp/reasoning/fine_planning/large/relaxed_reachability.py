"""What a compact program can reach if nothing that was ever true became false again.

No plan is shorter than it takes to reach every literal of its goal by itself in this way; and where
one is not reached, no plan does.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass

import clingo
from clingo import Number

from asp.language import is_positive
from asp.reasoning.fine_planning.large.relaxed_rules import Clauses, Graph, Spread
from asp.solving import preparation, theory


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
