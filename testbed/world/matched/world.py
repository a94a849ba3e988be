"""A world whose laws are matched against what is true, and never instantiated as a whole."""

from collections.abc import Iterable, Iterator
from dataclasses import replace
from functools import lru_cache
from itertools import product
from pathlib import Path

from asp.language import (
    Action,
    Description,
    Fluent,
    Literal,
    Signature,
    closed_world,
    ground_description,
    syntax,
)
from testbed.world.compiled import CompiledWorld
from testbed.world.matched.change import Change
from testbed.world.matched.laws import Laws
from testbed.world.world import Law, World

_SUCCESSORS = 4096


class MatchedWorld(World):
    """The backend for descriptions whose laws have too many instances to write them down."""

    def __init__(self, source: syntax.Source, signature: Signature) -> None:
        super().__init__(_declared(source, signature), remembered=_SUCCESSORS)
        self._arguments = (source, signature)
        self.signature = signature
        self.statics = closed_world(self.description.statics, signature)
        self._laws = Laws(source, signature, self.statics)
        self._described = lru_cache(1)(self._describe)

    def is_state(self, state: int) -> bool:
        facts = self.facts(state)
        heads = (head for law in self._laws.constraints for head in law.heads((), facts))
        return all(
            facts.may_hold(head.name, head.arguments) == head.is_positive for head in heads
        ) and self._founded(state)

    def _founded(self, state: int) -> bool:
        """Whether each true defined fluent is derived, in the end from none of its kind."""
        facts = self.facts(state)
        true = {atom for atom in self.true_atoms(state) if atom.name in self._laws.defined}
        bodies = [
            (instance.head, true.intersection(instance.body))
            for atom in true
            for pattern in self._laws.supports.get((atom.name, True), ())
            for instance in pattern.instances(atom.arguments, facts)
        ]
        derived: set[Fluent] = set()
        while more := {head for head, needs in bodies if needs <= derived} - derived:
            derived |= more
        return derived == true

    def states(self) -> Iterator[int]:
        """By way of the instances of the laws: where the states can be listed these can, too."""
        source, signature = self._arguments
        ground = ground_description(source, signature, self.description.name)
        return CompiledWorld(ground).states()

    def adjusted(self, state: int, literals: Iterable[Literal]) -> tuple[int, ...]:
        return self._changed(state, self._read(literals))

    def _completions(self, literals: tuple[Literal, ...]) -> Iterable[int]:
        return self._outcomes(0, self._described(literals))

    def _broken(self, literals: tuple[Literal, ...]) -> Law | None:
        law = self._described(literals).conflict()
        return None if law is None else ((law.head,), law.body)

    def _describe(self, literals: tuple[Literal, ...]) -> Change:
        """What the literals make of a state in which nothing is true."""
        nothing = self.facts(0)
        seeds = (head for law in self._laws.groundless for head in law.heads((), nothing))
        return Change(self._laws, nothing, self._read(literals), seeds)

    def _transitions(self, state: int, compound: frozenset[Action]) -> tuple[int, ...]:
        if next(self._forbidding(state, compound), None) is not None:
            return ()
        effects = (
            head
            for action in map(Literal.parse, sorted(compound))
            for law in self._laws.effects.get(action.name, ())
            for head in law.heads(action.arguments, self.facts(state))
        )
        return self._changed(state, dict.fromkeys(effects))

    def _changed(self, state: int, literals: Iterable[Literal]) -> tuple[int, ...]:
        change = Change(self._laws, self.facts(state), literals)
        return self._outcomes(state, change)

    def _outcomes(self, state: int, change: Change) -> tuple[int, ...]:
        """The state with the values that the change gives to its atoms, outcome by outcome."""
        touched = self._mask(change.touched)
        found = (
            state & ~touched | self._mask(atom for atom, holds in values.items() if holds)
            for values in change.outcomes()
        )
        return tuple(sorted(found))

    def _forbidding(self, state: int, compound: frozenset[Action]) -> Iterator[Law]:
        by_name: dict[str, list[Literal]] = {}
        for action in map(Literal.parse, sorted(compound)):
            by_name.setdefault(action.name, []).append(action)
        for names, law in self._laws.prohibitions:
            for given in product(*(by_name.get(name, ()) for name in names)):
                arguments = tuple(x for action in given for x in action.arguments)
                for body in law.bodies(arguments, self.facts(state)):
                    yield given, body

    def _seen(self, state: int, robot: str) -> int:
        facts = self.facts(state)
        return self._mask(
            {head for law in self._laws.sights for head in law.heads((robot,), facts)}
        )

    def _mask(self, atoms: Iterable[Fluent]) -> int:
        return sum(1 << self._numbers[atom][0] for atom in atoms)

    def _read(self, literals: Iterable[Literal]) -> list[Literal]:
        """The literals, each once. Raises UnknownFluentError."""
        numbered = dict.fromkeys(map(self._numbered, literals))
        return [
            self.fluents[number] if positive else self.fluents[number].complement
            for number, positive in numbered
        ]


def _declared(source: syntax.Source, signature: Signature) -> Description:
    """The ground description without the laws about fluents."""
    laws = (syntax.CausalLaw, syntax.ExecutabilityCondition, syntax.TriggerStatement)
    kept = tuple(
        s for s in source.statements if not isinstance(s, laws) and not _about_fluents(s, signature)
    )
    return ground_description(replace(source, statements=kept), signature, Path(source.file).stem)


def _about_fluents(statement: syntax.Statement, signature: Signature) -> bool:
    if not isinstance(statement, syntax.StateConstraint):
        return False
    return signature.symbols[statement.head.atom.name].kind != "static"
