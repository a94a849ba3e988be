"""The laws of a description as patterns, each found by what could make it matter."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass

from asp.language import Signature, syntax, variable_domains
from testbed.world.matched.facts import Facts, GroundAtom, GroundLiteral, Truth
from testbed.world.matched.joins import (
    Arg,
    Condition,
    Emit,
    Env,
    Membership,
    Sameness,
    Scope,
    Template,
)


@dataclass(frozen=True)
class Instance:
    """`head if body` with the fluent literals only; what is static is known to hold."""

    head: GroundLiteral
    body: tuple[GroundLiteral, ...]


Found = Callable[[Instance], bool]
"""What is done with an instance; True ends the search."""


class Pattern:
    """A law of which some atoms are given; the rest of it is searched for."""

    def __init__(
        self,
        scope: Scope,
        given: Sequence[Template],
        head: Membership | None,
        body: Sequence[Condition],
        conditions: Sequence[Condition],
    ) -> None:
        bound: frozenset[int] = frozenset()
        self._unify = []
        for template in given:
            self._unify.append(scope.unifier(template, bound))
            bound |= template.slots
        self._head = head
        self.head_name = "" if head is None else head.atom.name
        self._fluents = [c for c in body if isinstance(c, Membership) and not c.static]
        wanted = frozenset().union(*(c.slots for c in [*body, *([head] if head else [])]))
        self._search = scope.join(conditions, bound, wanted)
        self._slots = len(scope.domains)

    def search(self, given: Sequence[GroundAtom], truth: Truth, found: Found) -> bool:
        """Calls `found` with every instance that may apply; whether it ended the search."""
        return self._each(given, truth, lambda env: found(self._instance(env)))

    def search_heads(
        self, given: Sequence[GroundAtom], truth: Truth, found: Callable[[GroundAtom], object]
    ) -> None:
        """Calls `found` with the atom of the head of every instance that may apply."""
        assert self._head is not None
        ground = self._head.atom.ground

        def emit(env: Env) -> bool:
            found(ground(env))
            return False

        self._each(given, truth, emit)

    def _each(self, given: Sequence[GroundAtom], truth: Truth, emit: Emit) -> bool:
        env = [""] * self._slots
        for unify, atom in zip(self._unify, given, strict=True):
            if not unify(atom, env):
                return False
        return self._search(env, truth, emit)

    def _instance(self, env: list[str]) -> Instance:
        head = self._head
        return Instance(
            head=(("",), True) if head is None else (head.atom.ground(env), head.positive),
            body=tuple((c.atom.ground(env), c.positive) for c in self._fluents),
        )


@dataclass(frozen=True)
class Prohibition:
    """The actions that a law forbids together, by name, and its pattern with them as given."""

    names: tuple[str, ...]
    pattern: Pattern


class Laws:
    """Every law of a description, compiled."""

    def __init__(self, source: syntax.Source, signature: Signature, statics: Facts) -> None:
        self._signature = signature
        self._statics = statics
        self.effects: dict[str, list[Pattern]] = defaultdict(list)
        """Causal laws by the name of the action, which is given."""
        self.prohibitions: list[Prohibition] = []
        self.sights: list[Pattern] = []
        """What is seen, given the atom `("", robot)`."""
        self.consequences: dict[tuple[str, bool], list[tuple[bool, Pattern]]] = defaultdict(list)
        """Constraints by a literal of the body, which is given, each with the sign of its head; a
        negative head must be possible as an atom: else it holds already."""
        self.grounds: dict[tuple[str, bool], list[Pattern]] = defaultdict(list)
        """Those of them that define a fluent, likewise."""
        self.supports: dict[tuple[str, bool], list[Pattern]] = defaultdict(list)
        """Constraints by their head, which is given."""
        self.constraints: list[Pattern] = []
        """Constraints with nothing given, a negative head as for `consequences`."""
        self.groundless: list[Pattern] = []
        """Those of them that need no true atom: they may apply where nothing is true."""
        for law in source.each(syntax.CausalLaw):
            self._add_effect(law)
        for condition in source.each(syntax.ExecutabilityCondition):
            self._add_prohibition(condition)
        for sight in source.each(syntax.SeesStatement):
            self._add_sight(sight)
        for constraint in source.each(syntax.StateConstraint):
            if signature.symbols[constraint.head.atom.name].kind != "static":
                self._add_constraint(constraint)
        self.wavering = self._wavering()
        """The defined fluents that may fall by nothing but their own falling."""

    def _add_effect(self, law: syntax.CausalLaw) -> None:
        read = Reader(law, self._signature, self._statics)
        head, body = read.membership(law.head), read.conditions(law.body)
        pattern = Pattern(read.scope, [read.template(law.action)], head, body, body)
        self.effects[law.action.name].append(pattern)

    def _add_prohibition(self, law: syntax.ExecutabilityCondition) -> None:
        read = Reader(law, self._signature, self._statics)
        body = read.conditions(law.body)
        pattern = Pattern(read.scope, [read.template(a) for a in law.actions], None, body, body)
        self.prohibitions.append(Prohibition(tuple(a.name for a in law.actions), pattern))

    def _add_sight(self, sight: syntax.SeesStatement) -> None:
        read = Reader(sight, self._signature, self._statics)
        head = read.membership(syntax.Literal(sight.fluent, True))
        body = read.conditions(sight.body)
        robot = Template("", (read.arg(sight.robot),))
        self.sights.append(Pattern(read.scope, [robot], head, body, body))

    def _add_constraint(self, law: syntax.StateConstraint) -> None:
        read = Reader(law, self._signature, self._statics)
        head, body = read.membership(law.head), read.conditions(law.body)
        news = [] if head.positive else [Membership(head.atom, True, False)]
        fluents = [c for c in body if isinstance(c, Membership) and not c.static]
        for given in fluents:
            rest = [c for c in body if c is not given]
            pattern = Pattern(read.scope, [given.atom], head, body, [*rest, *news])
            key = given.atom.name, given.positive
            self.consequences[key].append((head.positive, pattern))
            if self._signature.symbols[head.atom.name].kind == "defined":
                self.grounds[key].append(pattern)
        by_head = Pattern(read.scope, [head.atom], head, body, body)
        self.supports[head.atom.name, head.positive].append(by_head)
        anywhere = Pattern(read.scope, [], head, body, [*body, *news])
        self.constraints.append(anywhere)
        if not any(c.positive for c in fluents):
            self.groundless.append(anywhere)

    def _wavering(self) -> frozenset[str]:
        """Those whose negation derives, by their names, what takes their derivation away.

        With `d if f` and `-f if -d` both values of d and f are outcomes of doing nothing.
        """
        after: dict[tuple[str, bool], set[tuple[str, bool]]] = defaultdict(set)
        for literal, patterns in self.consequences.items():
            after[literal] |= {(pattern.head_name, sign) for sign, pattern in patterns}
        first = {literal: frozenset(heads) for literal, heads in after.items()}
        for (name, positive), defining in self.grounds.items():
            after[name, not positive] |= {(pattern.head_name, False) for pattern in defining}
        defined = (n for n, symbol in self._signature.symbols.items() if symbol.kind == "defined")
        return frozenset(
            name
            for name in defined
            if (name, False) in _reached(first.get((name, False), ()), after)
        )


def _reached(
    starts: Iterable[tuple[str, bool]], after: Mapping[tuple[str, bool], set[tuple[str, bool]]]
) -> set[tuple[str, bool]]:
    found: set[tuple[str, bool]] = set()
    stack = list(starts)
    while stack:
        literal = stack.pop()
        if literal not in found:
            found.add(literal)
            stack += after.get(literal, ())
    return found


class Reader:
    """The atoms of one statement with its variables as slots."""

    def __init__(self, statement: syntax.Statement, signature: Signature, statics: Facts) -> None:
        domains = variable_domains(statement, signature)
        self._slots = {name: slot for slot, name in enumerate(domains)}
        self._signature = signature
        self.scope = Scope(tuple(map(frozenset, domains.values())), statics)

    def arg(self, term: syntax.Term) -> Arg:
        return self._slots[term.name] if term.is_variable else term.name

    def template(self, atom: syntax.Atom) -> Template:
        return Template(atom.name, tuple(map(self.arg, atom.args)))

    def membership(self, literal: syntax.Literal) -> Membership:
        static = self._signature.symbols[literal.atom.name].kind == "static"
        return Membership(self.template(literal.atom), literal.positive, static)

    def conditions(self, body: Iterable[syntax.Condition]) -> list[Condition]:
        """The body without its sorts, which the domains of the variables say already."""
        return [
            Sameness(self.arg(c.left), self.arg(c.right), c.equal)
            if isinstance(c, syntax.Comparison)
            else self.membership(c)
            for c in body
            if isinstance(c, syntax.Comparison) or not self._is_sort(c)
        ]

    def _is_sort(self, literal: syntax.Literal) -> bool:
        return literal.atom.name in self._signature.sorts
