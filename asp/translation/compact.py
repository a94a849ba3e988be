"""A translation of AL_d that grounds only what can be true: falsity is the absence of truth.

The literal translation has a rule for every pair of values that exclude each other, and every pair
of places that an action cannot lead between. Where a fluent is a function
(`asp.language.functions`), one rule a value says the same. The program has the parts base, open,
state(t) and step(t), and goes with the theory `incremental_fine_planning`; its answer sets, where a
state is complete, are the translation's.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence

from asp.language import (
    Function,
    Signature,
    excluding_place,
    functions,
    named,
    syntax,
    without_exogenous,
)
from asp.language import variable_sorts as roles
from asp.translation.executability import allowing
from asp.translation.program_parts import ACTION, BASE, BEFORE, NOW, OPEN, STATE, STEP, Rule
from asp.translation.rules import term_text


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
        for symbol in self._signature.symbols.values():
            if symbol.kind == "inertial":
                yield from self._inertia(symbol)
        for constraint in self._source.each(syntax.StateConstraint):
            yield from self._constraint(constraint)
        for law in self._source.each(syntax.CausalLaw):
            occurs = f"occurs({term_text(law.action)},{BEFORE})"
            yield self._effect(STEP, law, [occurs, *self._body(law.body, BEFORE)])
        yield from self._actions()

    def _inertia(self, symbol: syntax.Declaration) -> Iterator[Rule]:
        """What is true at step 0 is chosen; afterwards it stays, unless something else follows."""
        given = [f"X{number}" for number, _ in enumerate(symbol.sorts)]
        fluent, sorts = _term(symbol.name, given), _sorts(symbol, given)
        gives = self._gives(symbol.name, given)
        chosen = gives or ("", fluent)
        yield Rule(OPEN, f"{{ holds({fluent},0) }}", tuple(sorts), gives=chosen)
        stays = [f"holds({fluent},{BEFORE})", f"not denied({fluent},{NOW})"]
        if gives is not None:
            stays.append(f"not changed({gives[0]},{NOW})")
            yield from self._function(symbol, given, self._functions[symbol.name])
        yield Rule(STEP, f"holds({fluent},{NOW})", tuple(stays), gives=gives)

    def _function(
        self, symbol: syntax.Declaration, given: Sequence[str], function: Function
    ) -> Iterator[Rule]:
        """A function has one value; where a new one is true, the old one is not.

        That a total one has a value at first is assumed by placed(K) where it is not told which.
        """
        fluent, sorts = _term(symbol.name, given), _sorts(symbol, given)
        others = _without(given, function.place)
        subject, value = _term(symbol.name, others), sorts[function.place]
        new = (f"holds({fluent},{NOW})", f"not holds({fluent},{BEFORE})")
        yield Rule(STEP, f"changed({subject},{NOW})", new)
        body = _without(sorts, function.place)
        most = f"2 {{ holds({fluent},{NOW}) : {value} }}"
        yield Rule(STATE, "", (most, *body))
        if function.total:
            yield Rule(OPEN, f"{{ placed({subject}) }}", tuple(body))
            some = f"not 1 {{ holds({fluent},0) : {value} }}"
            yield Rule(OPEN, "", (f"placed({subject})", some, *body))

    def _gives(self, name: str, arguments: Sequence[str]) -> tuple[str, str] | None:
        """The function that a fluent gives a value, and the fluent, if it is a function's."""
        function = self._functions.get(name)
        if function is None:
            return None
        return _term(name, _without(arguments, function.place)), _term(name, arguments)

    def _constraint(self, law: syntax.StateConstraint) -> Iterator[Rule]:
        name = law.head.atom.name
        if self._signature.symbols[name].kind == "static":
            yield self._rule(BASE, law, term_text(law.head.atom), self._body(law.body, NOW))
            return
        for literal in roles.literals(law.body):
            if not literal.positive and self._kind(literal) == "inertial":
                raise NotCompactError(f"line {law.place.line}: a constraint on a false fluent")
        function = self._functions.get(name)
        if function is None or excluding_place(law) != function.place:
            yield self._effect(STATE, law, self._body(law.body, NOW))

    def _effect(
        self, part: str, law: syntax.CausalLaw | syntax.StateConstraint, body: Iterable[str]
    ) -> Rule:
        """The rule of a law with a fluent for its head."""
        atom = law.head.atom
        if not law.head.positive:
            return self._rule(part, law, f"denied({term_text(atom)},{NOW})", body)
        gives = self._gives(atom.name, [term.name for term in atom.args])
        return self._rule(part, law, f"holds({term_text(atom)},{NOW})", body, gives)

    def _actions(self) -> Iterator[Rule]:
        """Which actions are enabled: by conditions that each allow them, and others that forbid."""
        numbers: dict[str, list[int]] = {}
        for number, law in enumerate(self._source.each(syntax.ExecutabilityCondition)):
            cases = allowing(law, self._functions)
            if cases is None:
                occurs = [f"occurs({term_text(action)},{BEFORE})" for action in law.actions]
                yield self._rule(STEP, law, "", [*occurs, *self._body(law.body, BEFORE)])
                continue
            action = law.actions[0]
            numbers.setdefault(action.name, []).append(number)
            head = f"allowed({number},{term_text(action)},{BEFORE})"
            for case in cases:
                yield self._rule(STEP, law, head, self._body(case, BEFORE))
        for symbol in self._signature.symbols.values():
            if symbol.kind == "agent":
                given = [f"X{number}" for number, _ in enumerate(symbol.sorts)]
                action_term = _term(symbol.name, given)
                body = [
                    f"allowed({n},{action_term},{BEFORE})" for n in numbers.get(symbol.name, ())
                ]
                head = f"enabled({action_term},{BEFORE})"
                gives = ACTION, action_term
                yield Rule(STEP, head, (*body, *_sorts(symbol, given)), gives=gives)

    def _body(self, body: Iterable[syntax.Condition], step: str) -> list[str]:
        return [self._condition(part, step) for part in body]

    def _condition(self, part: syntax.Condition, step: str) -> str:
        if isinstance(part, syntax.Comparison):
            return f"{part.left.name} {'=' if part.equal else '!='} {part.right.name}"
        text = term_text(part.atom)
        if self._kind(part) != "static":
            text = f"holds({text},{step})"
        return text if part.positive else f"not {text}"

    def _kind(self, literal: syntax.Literal) -> str:
        name = literal.atom.name
        return "static" if name in self._signature.sorts else self._signature.symbols[name].kind

    def _rule(
        self,
        part: str,
        law: syntax.Statement,
        head: str,
        body: Iterable[str],
        gives: tuple[str, str] | None = None,
    ) -> Rule:
        """The rule, with the sorts of the law's variables."""
        sorts = dict.fromkeys(
            f"{sort}({term.name})"
            for use in roles.uses(law)
            if use.atom.name not in self._signature.sorts
            for term, sort in zip(
                use.atom.args,
                (s.name for s in self._signature.symbols[use.atom.name].sorts),
                strict=True,
            )
            if term.is_variable
        )
        return Rule(part, head, (*body, *sorts), frozenset(named(law)), gives)


def _sorts(symbol: syntax.Declaration, given: Sequence[str]) -> list[str]:
    return [f"{sort.name}({name})" for sort, name in zip(symbol.sorts, given, strict=True)]


def _term(name: str, arguments: Sequence[str]) -> str:
    return f"{name}({','.join(arguments)})" if arguments else name


def _without(items: Sequence[str], place: int) -> list[str]:
    return [item for number, item in enumerate(items) if number != place]
