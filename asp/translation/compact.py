"""A translation of AL_d that grounds only what can be true: falsity is the absence of truth.

The literal translation has a rule for every pair of values that exclude each other, and every pair
of places that an action cannot lead between. Where a fluent is a function
(`asp.language.functions`), one rule per value says the same. The program has the parts base, open,
state(t) and step(t), and goes with the theory `incremental_fine_planning`; its answer sets, where a
state is complete, are the translation's.
"""

from collections import defaultdict
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace

from asp.language import (
    Function,
    Literal,
    Signature,
    excluding_place,
    functions,
    named,
    schematic,
    syntax,
    without_exogenous,
)
from asp.language import variable_sorts as roles
from asp.translation.rules import (
    ACTION,
    BEFORE,
    NOW,
    Part,
    Rule,
    condition,
    schema,
    sort_conditions,
    sorts_of_variables,
)

Law = syntax.CausalLaw | syntax.StateConstraint | syntax.ExecutabilityCondition


class NotCompactError(ValueError):
    """A description whose laws cannot be put in terms of what is true only."""


def compact(source: syntax.Source, signature: Signature) -> tuple[Rule, ...]:
    """The rules of a description, exogenous actions and facts apart. Raises NotCompactError."""
    return tuple(_Translation(without_exogenous(source, signature), signature).rules())


class _Translation:
    def __init__(self, source: syntax.Source, signature: Signature) -> None:
        self._source = source
        self._signature = signature
        self._functions = functions(source, signature)

    def rules(self) -> Iterator[Rule]:
        for symbol in self._signature.of_kind("inertial"):
            yield from self._inertia(symbol)
        for constraint in self._source.each(syntax.StateConstraint):
            yield from self._constraint(constraint)
        for law in self._source.each(syntax.CausalLaw):
            yield self._effect(law)
        yield from self._actions()

    def _inertia(self, symbol: syntax.Declaration) -> Iterator[Rule]:
        """What is true at step 0 is chosen; afterwards it stays, unless something else follows."""
        fluent, given, sorts = schema(symbol)
        gives = self._gives(symbol.name, given)
        chosen = gives or ("", fluent)
        yield Rule(Part.OPEN, f"{{ holds({fluent},0) }}", tuple(sorts), gives=chosen)
        stays = [f"holds({fluent},{BEFORE})", f"not denied({fluent},{NOW})"]
        if gives is not None:
            stays.append(f"not changed({gives[0]},{NOW})")
            yield from self._function(symbol, self._functions[symbol.name])
        yield Rule(Part.STEP, f"holds({fluent},{NOW})", tuple(stays), gives=gives)

    def _function(self, symbol: syntax.Declaration, function: Function) -> Iterator[Rule]:
        """A function has one value; where a new one is true, the old one is not.

        That a total one has a value at first is assumed by placed(K) where it is not told which.
        """
        fluent, given, sorts = schema(symbol)
        subject = Literal.of(symbol.name, function.others(given))
        value = sorts[function.place]
        new = (f"holds({fluent},{NOW})", f"not holds({fluent},{BEFORE})")
        yield Rule(Part.STEP, f"changed({subject},{NOW})", new)
        body = function.others(sorts)
        most = f"2 {{ holds({fluent},{NOW}) : {value} }}"
        yield Rule(Part.STATE, "", (most, *body))
        if function.total:
            yield Rule(Part.OPEN, f"{{ placed({subject}) }}", tuple(body))
            some = f"not 1 {{ holds({fluent},0) : {value} }}"
            yield Rule(Part.OPEN, "", (f"placed({subject})", some, *body))

    def _gives(self, name: str, arguments: Sequence[str]) -> tuple[str, str] | None:
        """The function that a fluent gives a value, and the fluent, if it is a function's."""
        function = self._functions.get(name)
        if function is None:
            return None
        return Literal.of(name, function.others(arguments)), Literal.of(name, arguments)

    def _constraint(self, law: syntax.StateConstraint) -> Iterator[Rule]:
        name = law.head.atom.name
        if self._signature.symbols[name].kind == "static":
            yield self._rule(Part.BASE, law, str(law.head.atom), law.body)
            return
        for literal in roles.literals(law.body):
            if not literal.positive and self._signature.kind(literal.atom.name) == "inertial":
                raise NotCompactError(f"line {law.place.line}: a constraint on a false fluent")
        function = self._functions.get(name)
        if function is None or excluding_place(law) != function.place:
            yield self._effect(law)

    def _effect(self, law: syntax.CausalLaw | syntax.StateConstraint) -> Rule:
        """The rule of a law with a fluent for its head."""
        occurring = [law.action] if isinstance(law, syntax.CausalLaw) else []
        part, atom = Part.STEP if occurring else Part.STATE, law.head.atom
        if not law.head.positive:
            return self._rule(part, law, f"denied({atom},{NOW})", law.body, occurring)
        gives = self._gives(atom.name, [term.name for term in atom.args])
        return self._rule(part, law, f"holds({atom},{NOW})", law.body, occurring, gives)

    def _actions(self) -> Iterator[Rule]:
        """Which actions are enabled: by conditions that each allow them, and others that forbid."""
        numbers: dict[str, list[int]] = defaultdict(list)
        for number, law in enumerate(self._source.each(syntax.ExecutabilityCondition)):
            cases = _allowing(law, self._functions)
            if cases is None:
                yield self._rule(Part.STEP, law, "", law.body, law.actions)
                continue
            action = law.actions[0]
            numbers[action.name].append(number)
            head = f"allowed({number},{action},{BEFORE})"
            for case in cases:
                yield self._rule(Part.STEP, law, head, case)
        for symbol in self._signature.of_kind("agent"):
            term, _, sorts = schema(symbol)
            body = [f"allowed({n},{term},{BEFORE})" for n in numbers[symbol.name]]
            head = f"enabled({term},{BEFORE})"
            yield Rule(Part.STEP, head, (*body, *sorts), gives=(ACTION, term))

    def _rule(
        self,
        part: Part,
        law: Law,
        head: str,
        body: Sequence[syntax.Condition],
        occurring: Sequence[syntax.Atom] = (),
        gives: tuple[str, str] | None = None,
    ) -> Rule:
        """The rule, with the sorts of the law's variables."""
        step = BEFORE if part is Part.STEP else NOW
        texts = [f"occurs({action},{BEFORE})" for action in occurring]
        texts += (condition(each, self._signature, step, "not ") for each in body)
        texts += sort_conditions(law, self._signature)
        loose = self._loose(law, body)
        return Rule(part, head, tuple(texts), frozenset(named(law)), gives, loose)

    def _loose(self, law: Law, body: Sequence[syntax.Condition]) -> frozenset[str]:
        """The sorts of variables in neither the law's head, nor its action, nor a true fluent."""
        kind = self._signature.kind
        atoms = [part.atom for part in roles.literals(body) if part.positive]
        own = [use.atom for use in roles.uses(replace(law, body=()))]
        own += (atom for atom in atoms if kind(atom.name) in roles.FLUENTS)
        tied = {term.name for atom in own for term in atom.args}
        sorts = [(atom.args[0].name, atom.name) for atom in atoms if kind(atom.name) == roles.SORT]
        sorts += sorts_of_variables(law, self._signature)
        return frozenset(sort for variable, sort in sorts if variable not in tied)


def _allowing(
    law: syntax.ExecutabilityCondition, functions: Mapping[str, Function]
) -> list[list[syntax.Condition]] | None:
    """Conjunctions one of which is true exactly where the law says nothing; None: no such.

    It has where all its variables are the action's, or values of total functions of these: then
    there is one instance, and one of its other conditions has to be false. `functions` are the
    fluents that are such, by name.
    """
    if len(law.actions) != 1 or not schematic(law.actions[0]):
        return None
    known = {term.name for term in law.actions[0].args}
    values = {part: v for part in law.body if (v := _value_named(part, known, functions))}
    guards = [part for part in law.body if part not in values]
    known.update(values.values())
    apart = len(set(values.values())) == len(values)
    if not (apart and guards and all(_is_open(guard, known) for guard in guards)):
        return None
    return [[*values, replace(guard, positive=True)] for guard in guards]


def _value_named(
    part: syntax.Condition, known: set[str], functions: Mapping[str, Function]
) -> str | None:
    """The variable for which a condition only names the value of a total function of the known."""
    if not isinstance(part, syntax.Literal) or not part.positive:
        return None
    function = functions.get(part.atom.name)
    if function is None or not function.total:
        return None
    value = part.atom.args[function.place]
    others = {term.name for term in function.others(part.atom.args)}
    return value.name if value.is_variable and value.name not in known and known >= others else None


def _is_open(guard: syntax.Condition, known: set[str]) -> bool:
    """Whether a condition is negative, so that few instances make it false, and all is known."""
    return not guard.positive and all(t.name in known or not t.is_variable for t in guard.terms)
