"""A part of a compact description, and its sessions: plans of exactly so many steps.

Constants are named by position, so that parts that differ in names only are equal.
"""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from functools import cached_property
from itertools import chain

import clingo
from clingo import Number, Symbol

from asp.language import Action, Fluent, Literal, Signature, syntax
from asp.reasoning.fine_planning.large.relaxed_reachability import Relaxed
from asp.solving import fact, ground, literal_of, preparation, solving, theory
from asp.translation import Part, Rule, compact


class CompactDescription:
    """A description whose laws are translated once. Raises NotCompactError."""

    def __init__(self, source: syntax.Source, signature: Signature) -> None:
        self.signature = signature
        self.rules = compact(source, signature)
        self._constants = tuple(dict.fromkeys(m for ms in signature.sorts.values() for m in ms))
        # What laws name keeps its name.
        self._fixed = frozenset(c for rule in self.rules for c in rule.constants)
        self._facts: dict[str, list[Literal]] = defaultdict(list)
        for atom in (statement.literal.atom for statement in source.each(syntax.Fact)):
            stated = Literal.of(atom.name, (term.name for term in atom.args))
            self._facts[next(iter(stated.arguments), "")].append(stated)

    def part(self, constants: frozenset[str]) -> CompactPart:
        """The description with these constants only."""
        kept = [c for c in self._constants if c in constants]
        names = {c: c if c in self._fixed else f"x{number}" for number, c in enumerate(kept)}
        sorts = tuple(
            (sort, tuple(names[m] for m in members if m in names))
            for sort, members in self.signature.sorts.items()
        )
        facts = frozenset(
            stated.renamed(names)
            for first in (*kept, "")
            for stated in self._facts.get(first, ())
            if all(a in names for a in stated.arguments)
        )
        return CompactPart(sorts, facts, names, self)


@dataclass(frozen=True)
class CompactPart:
    """A part of a description in canonical names.

    `members` are those of each sort and `facts` the true statics that are stated; two parts of a
    `whole` with equal ones have the same transitions, and are equal. `names` leads from the old
    names to the canonical ones.
    """

    members: tuple[tuple[str, tuple[str, ...]], ...]
    facts: frozenset[str]
    names: Mapping[str, str] = field(compare=False)
    whole: CompactDescription

    @cached_property
    def sorts(self) -> Mapping[str, tuple[str, ...]]:
        """The members of each sort."""
        return dict(self.members)

    def seen(self, literals: Iterable[Literal]) -> tuple[Literal, ...]:
        """Those of the literals that name nothing else, in canonical names."""
        return tuple(
            literal.renamed(self.names)
            for literal in literals
            if all(constant in self.names for constant in literal.arguments)
        )

    def back(self, actions: Iterable[Action]) -> tuple[Literal, ...]:
        """Actions in the names of the description."""
        back = {new: old for old, new in self.names.items()}
        return tuple(action.renamed(back) for action in actions)

    @cached_property
    def rules(self) -> Sequence[Rule]:
        """The rules that name nothing else."""
        return [rule for rule in self.whole.rules if rule.constants <= self.names.keys()]

    @cached_property
    def actions(self) -> Sequence[Action]:
        """The agent actions in the order of declaration, in canonical names."""
        return Signature(self.sorts, self.whole.signature.symbols).atoms("agent")

    @cached_property
    def program(self) -> str:
        """The compact program."""
        facts = [f"{sort}({member})." for sort, ms in self.sorts.items() for member in ms]
        facts += (f"{static}." for static in sorted(self.facts))
        return "\n".join([self.worded(Rule.plain), f"#program {Part.BASE}.", *facts])

    @cached_property
    def relaxed(self) -> Relaxed:
        """What the program can reach if nothing becomes false again."""
        return Relaxed(self.program)

    def worded(self, wording: Callable[[Rule], Iterable[str]]) -> str:
        """The rules of the program, without the facts about constants and statics."""
        parts: dict[Part, list[str]] = {part: [] for part in Part}
        for rule in self.rules:
            parts[rule.part] += wording(rule)
        parts[Part.BASE] += (f"#defined {sort}/1." for sort in self.sorts)
        for symbol in self.whole.signature.symbols.values():
            if symbol.kind == "static":
                parts[Part.BASE].append(f"#defined {symbol.name}/{len(symbol.sorts)}.")
        return "\n".join(f"#program {part}.\n" + "\n".join(lines) for part, lines in parts.items())


MOST_LEVELS = 32_767  # of decisions, that clasp tells apart


class Horizon:
    """The transitions of so many steps; the start and the goal are assumed.

    Of shortest plans the first in the order of declaration is found, as far as clasp tells levels
    of decisions apart: actions beyond step 32,767 / (number of actions) come in any order.
    """

    def __init__(self, part: CompactPart, length: int) -> None:
        self._length = length
        count = len(part.actions)
        ranks = [fact("ranks", count), *(fact("rank", a, n) for n, a in enumerate(part.actions))]
        constants = {"n": length, "ordered": min(length, MOST_LEVELS // (count + 1))}
        with preparation():
            texts = part.program, theory("incremental_fine_planning")
            self.control = ground(texts, constants, ranks)
            self.control.ground([("open", [])])
            self._initial = _literals(self.control, "holds", 2)
            self._placed = _literals(self.control, "placed", 1)
            self.control.ground(parts(length))
            # The first call prepares the solver, whatever it is asked.
            with solving(self.control):
                pass
        self._goals: dict[str, int | None] = {}

    def start(
        self, true: frozenset[Fluent], candidates: Mapping[Fluent, Sequence[Fluent]]
    ) -> list[int]:
        """Assumptions that make these fluents true at step 0 and leave the candidates open.

        Of the candidates for the value of each function (`fine_loc(box)`) one is true; all other
        fluents are false.
        """
        open_ = frozenset(chain(*candidates.values()))
        assumed = [
            number if fluent in true else -number
            for fluent, number in self._initial.items()
            if fluent not in open_
        ]
        return [*assumed, *(self._placed[function] for function in candidates)]

    def plan(self, start: Sequence[int], goal: Iterable[Literal]) -> tuple[Action, ...] | None:
        """The first plan of exactly this length, or None. Raises LimitError."""
        assumptions = [*start]
        for literal in goal:
            number = self._wanted(literal.atom)
            if number is not None:
                assumptions.append(number if literal.is_positive else -number)
            elif literal.is_positive:
                return None
        with solving(self.control, assumptions) as model:
            return None if model is None else read(model)

    def _wanted(self, fluent: Fluent) -> int | None:
        """The solver's literal of a fluent at the last step; None if it cannot hold."""
        if fluent not in self._goals:
            holds = fact("holds", fluent, self._length)
            found = self.control.symbolic_atoms[holds]
            self._goals[fluent] = None if found is None else found.literal or None
        return self._goals[fluent]


def _literals(control: clingo.Control, predicate: str, arity: int) -> dict[str, int]:
    """The solver's literals of a predicate's atoms by their first argument."""
    return {
        str(found.symbol.arguments[0]): found.literal
        for found in control.symbolic_atoms.by_signature(predicate, arity)
    }


def parts(length: int) -> list[tuple[str, list[Symbol]]]:
    """The parts of the program that so many steps have, in order."""
    parts: list[tuple[str, list[Symbol]]] = [("state", [Number(0)])]
    for step in range(1, length + 1):
        parts += [("step", [Number(step)]), ("state", [Number(step)])]
    return parts


def read(model: clingo.Model) -> tuple[Action, ...]:
    """The actions that occur in a model, in order."""
    shown = (each.arguments for each in model.symbols(shown=True))
    steps = sorted((step.number, literal_of(action)) for action, step in shown)
    return tuple(action for _, action in steps)
