"""From a checked source to the ground description."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass
from itertools import product

from asp import syntax
from asp.checker import variable_domains
from asp.description import (
    Causal,
    Constraint,
    Description,
    Executability,
    Sees,
    Shows,
    Trigger,
)
from asp.literals import ground
from asp.signature import Signature

Binding = Mapping[str, str]


def ground_description(source: syntax.Source, signature: Signature, name: str) -> Description:
    """Instantiates every statement over the members of its variables' sorts."""
    grounder = _Grounder(source, signature, frozenset())
    grounder = _Grounder(source, signature, grounder.statics())
    return Description(
        name=name,
        source=source.text,
        sorts=dict(signature.sorts),
        statics=grounder.known_statics,
        inertial=grounder.symbols("inertial"),
        defined=grounder.symbols("defined"),
        agent_actions=grounder.symbols("agent"),
        exogenous_actions=grounder.symbols("exogenous"),
        causal=grounder.causal(),
        constraints=grounder.constraints(),
        executability=grounder.executability(),
        sees=grounder.sees(),
        shows=grounder.shows(),
        costs=grounder.costs(),
        initially=grounder.initially(),
        triggers=grounder.triggers(),
    )


def ground_law(
    law: syntax.StateConstraint, source: syntax.Source, signature: Signature
) -> Iterator[tuple[str, tuple[str, ...]]]:
    """The head and the fluent literals of the body of each instance of a state constraint."""
    grounder = _Grounder(source, signature, frozenset())
    grounder = _Grounder(source, signature, grounder.statics())
    for binding, body in grounder.instances(law):
        yield _literal(law.head, binding), body


@dataclass(frozen=True)
class _Grounder:
    source: syntax.Source
    signature: Signature
    known_statics: frozenset[str]

    def symbols(self, kind: syntax.SymbolKind) -> tuple[str, ...]:
        return tuple(
            ground(declaration.name, args)
            for declaration in self.signature.symbols.values()
            if declaration.kind == kind
            for args in product(*(self.signature.sorts[s.name] for s in declaration.sorts))
        )

    def statics(self) -> frozenset[str]:
        """The least set with the facts that is closed under the constraints on statics."""
        closed = {
            _atom(fact.literal.atom, binding)
            for fact in self.source.each(syntax.Fact)
            for binding in self._bindings(fact)
        }
        laws = [law for law in self.source.each(syntax.StateConstraint) if self._on_statics(law)]
        grew = True
        while grew:
            now = _Grounder(self.source, self.signature, frozenset(closed))
            derived = {
                _atom(law.head.atom, binding) for law in laws for binding, _ in now.instances(law)
            }
            grew = not derived <= closed
            closed |= derived
        return frozenset(closed)

    def causal(self) -> tuple[Causal, ...]:
        return tuple(
            Causal(_atom(law.action, binding), _literal(law.head, binding), body)
            for law in self.source.each(syntax.CausalLaw)
            for binding, body in self.instances(law)
        )

    def constraints(self) -> tuple[Constraint, ...]:
        return tuple(
            Constraint(_literal(law.head, binding), body)
            for law in self.source.each(syntax.StateConstraint)
            if not self._on_statics(law)
            for binding, body in self.instances(law)
        )

    def executability(self) -> tuple[Executability, ...]:
        return tuple(
            Executability(tuple(_atom(action, binding) for action in law.actions), body)
            for law in self.source.each(syntax.ExecutabilityCondition)
            for binding, body in self.instances(law)
        )

    def sees(self) -> tuple[Sees, ...]:
        return tuple(
            Sees(_value(statement.robot, binding), _atom(statement.fluent, binding), body)
            for statement in self.source.each(syntax.SeesStatement)
            for binding, body in self.instances(statement)
        )

    def shows(self) -> tuple[Shows, ...]:
        return tuple(
            Shows(_atom(statement.action, binding), _atom(statement.fluent, binding), body)
            for statement in self.source.each(syntax.ShowsStatement)
            for binding, body in self.instances(statement)
        )

    def costs(self) -> dict[str, int]:
        stated = {
            _atom(statement.action, binding): statement.units
            for statement in self.source.each(syntax.CostStatement)
            for binding in self._bindings(statement)
        }
        return {action: stated.get(action, 0) for action in self.symbols("agent")}

    def initially(self) -> tuple[tuple[str, ...], ...]:
        groups: dict[tuple[object, ...], list[str]] = {}
        for number, statement in enumerate(self.source.each(syntax.InitiallyStatement)):
            for binding in self._bindings(statement):
                others = (v for name, v in binding.items() if name != statement.variable.name)
                groups.setdefault((number, *others), []).append(_atom(statement.fluent, binding))
        return tuple(map(tuple, groups.values()))

    def triggers(self) -> tuple[Trigger, ...]:
        return tuple(
            Trigger(
                scenario=statement.scenario,
                event=_atom(statement.event, binding),
                upon=None if statement.upon is None else _atom(statement.upon, binding),
                drawn="" if statement.drawn is None else binding[statement.drawn.name],
                pool=pool,
                body=body,
                probability=statement.probability,
            )
            for statement in self.source.each(syntax.TriggerStatement)
            for binding in self._bindings(statement)
            if (pool := self._evaluate(statement.pool, binding)) is not None
            and (body := self._evaluate(statement.body, binding)) is not None
        )

    def instances(self, statement: syntax.Statement) -> Iterator[tuple[Binding, tuple[str, ...]]]:
        """The bindings that the statics and comparisons allow, with what is left of the body."""
        for binding in self._bindings(statement):
            body = self._evaluate(getattr(statement, "body", ()), binding)
            if body is not None:
                yield binding, body

    def _bindings(self, statement: syntax.Statement) -> Iterator[Binding]:
        domains = variable_domains(statement, self.signature)
        for values in product(*domains.values()):
            yield dict(zip(domains, values, strict=True))

    def _evaluate(
        self, body: Iterable[syntax.Condition], binding: Binding
    ) -> tuple[str, ...] | None:
        """The fluent literals of a body, or None if a static or a comparison fails."""
        kept = []
        for condition in body:
            if isinstance(condition, syntax.Comparison):
                same = _value(condition.left, binding) == _value(condition.right, binding)
                if same != condition.equal:
                    return None
            elif self._is_static(condition):
                if self._static_holds(condition, binding) != condition.positive:
                    return None
            else:
                kept.append(_literal(condition, binding))
        return tuple(dict.fromkeys(kept))

    def _is_static(self, literal: syntax.Literal) -> bool:
        name = literal.atom.name
        return name in self.signature.sorts or self.signature.symbols[name].kind == "static"

    def _static_holds(self, literal: syntax.Literal, binding: Binding) -> bool:
        if literal.atom.name in self.signature.sorts:
            return _value(literal.atom.args[0], binding) in self.signature.sorts[literal.atom.name]
        return _atom(literal.atom, binding) in self.known_statics

    def _on_statics(self, law: syntax.StateConstraint) -> bool:
        return self._is_static(law.head)


def _value(term: syntax.Term, binding: Binding) -> str:
    return binding.get(term.name, term.name)


def _atom(atom: syntax.Atom, binding: Binding) -> str:
    return ground(atom.name, (_value(term, binding) for term in atom.args))


def _literal(literal: syntax.Literal, binding: Binding) -> str:
    return ("" if literal.positive else "-") + _atom(literal.atom, binding)
