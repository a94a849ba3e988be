"""From a checked source to the ground description."""

from __future__ import annotations

from dataclasses import dataclass
from itertools import product

from asp.language import syntax
from asp.language.description import (
    Causal,
    Constraint,
    Default,
    Description,
    Executability,
    Literals,
    Sees,
    Shows,
    Trigger,
)
from asp.language.instances import Binding, Instances, atom_of, instances_of, literal_of, value_of
from asp.language.literals import Fluent, Literal
from asp.language.signature import Signature
from asp.language.variable_sorts import variable_domains


def ground_description(source: syntax.Source, signature: Signature, name: str) -> Description:
    """Instantiates every statement over the members of its variables' sorts."""
    grounder = _Grounder(instances_of(source, signature))
    return Description(
        name=name,
        source=source.text,
        sorts=dict(signature.sorts),
        statics=grounder.instances.known_statics,
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
        defaults=grounder.defaults(),
        triggers=grounder.triggers(),
        scenarios=grounder.scenarios(),
    )


@dataclass(frozen=True)
class _Grounder:
    instances: Instances

    @property
    def source(self) -> syntax.Source:
        return self.instances.source

    def symbols(self, kind: syntax.SymbolKind) -> tuple[Literal, ...]:
        return tuple(
            Literal.of(declaration.name, args)
            for declaration in self.instances.signature.symbols.values()
            if declaration.kind == kind
            for args in product(
                *(self.instances.signature.sorts[s.name] for s in declaration.sorts)
            )
        )

    def causal(self) -> tuple[Causal, ...]:
        return tuple(
            Causal(atom_of(law.action, binding), literal_of(law.head, binding), body)
            for law in self.source.each(syntax.CausalLaw)
            for binding, body in self.instances.of(law)
        )

    def constraints(self) -> tuple[Constraint, ...]:
        return tuple(
            Constraint(literal_of(law.head, binding), body)
            for law in self.source.each(syntax.StateConstraint)
            if not self.instances.on_statics(law)
            for binding, body in self.instances.of(law)
        )

    def executability(self) -> tuple[Executability, ...]:
        return tuple(
            Executability(tuple(atom_of(action, binding) for action in law.actions), body)
            for law in self.source.each(syntax.ExecutabilityCondition)
            for binding, body in self.instances.of(law)
        )

    def sees(self) -> tuple[Sees, ...]:
        return tuple(
            Sees(value_of(statement.robot, binding), atom_of(statement.fluent, binding), body)
            for statement in self.source.each(syntax.SeesStatement)
            for binding, body in self.instances.of(statement)
        )

    def shows(self) -> tuple[Shows, ...]:
        return tuple(
            Shows(
                atom_of(statement.action, binding),
                atom_of(statement.fluent, binding),
                body,
            )
            for statement in self.source.each(syntax.ShowsStatement)
            for binding, body in self.instances.of(statement)
        )

    def costs(self) -> dict[str, int]:
        stated = {
            atom_of(statement.action, binding): statement.units
            for statement in self.source.each(syntax.CostStatement)
            for binding in self.instances.bindings(statement)
        }
        return {action: stated.get(action, 0) for action in self.symbols("agent")}

    def initially(self) -> tuple[tuple[Fluent, ...], ...]:
        groups: dict[tuple[object, ...], list[Fluent]] = {}
        for number, statement in enumerate(self.source.each(syntax.InitiallyStatement)):
            for binding in self.instances.bindings(statement):
                others = (v for name, v in binding.items() if name != statement.variable.name)
                groups.setdefault((number, *others), []).append(atom_of(statement.fluent, binding))
        return tuple(map(tuple, groups.values()))

    def defaults(self) -> tuple[Default, ...]:
        """The defaults but those to which an exception applies whatever the state."""
        exceptions: dict[str, list[Literals]] = {}
        for statement in self.source.each(syntax.ExceptionStatement):
            for binding, body in self.instances.of(statement):
                exceptions.setdefault(self._name(statement.of, binding), []).append(body)
        return tuple(
            Default(name, literal_of(statement.head, binding), body, tuple(known))
            for statement in self.source.each(syntax.DefaultStatement)
            for binding, body in self.instances.of(statement)
            if () not in (known := exceptions.get(name := self._name(statement, binding), []))
        )

    def _name(self, default: syntax.DefaultStatement | None, binding: Binding) -> str:
        assert default is not None, "the checker has found every default"
        variables = variable_domains(default, self.instances.signature)
        return Literal.of(default.name, (binding[variable] for variable in variables))

    def triggers(self) -> tuple[Trigger, ...]:
        return tuple(
            Trigger(
                scenario=statement.scenario,
                event=atom_of(statement.event, binding),
                upon=None if statement.upon is None else atom_of(statement.upon, binding),
                drawn="" if statement.drawn is None else binding[statement.drawn.name],
                pool=pool,
                body=body,
                probability=statement.probability,
            )
            for statement in self.source.each(syntax.TriggerStatement)
            for binding in self.instances.bindings(statement)
            if (pool := self.instances.evaluate(statement.pool, binding)) is not None
            and (body := self.instances.evaluate(statement.body, binding)) is not None
        )

    def scenarios(self) -> tuple[str, ...]:
        return tuple(
            dict.fromkeys(
                statement.scenario
                for statement in self.source.statements
                if isinstance(statement, syntax.TriggerStatement | syntax.QuietStatement)
            )
        )
