"""Qualifications: executability conditions that no law states, but that follow from the laws.

An action has no successor in a state where its effects contradict a state constraint, together with
what is kept of that state. Such a case is looked for, its reason is generalised to a condition, and
so on until the conditions cover every case.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from functools import cached_property
from itertools import chain
from typing import NamedTuple

from clingo import Symbol

from asp.language import Action, Description, Literal, analyse
from asp.reasoning.contradictions import suspects
from asp.reasoning.laws import laws, term
from asp.reasoning.relevance import interchangeable
from asp.reasoning.successors import Transitions, in_order
from asp.solving import (
    LimitError,
    Limits,
    State,
    deciding,
    fact,
    first_model,
    ground,
    literal_of,
    select,
    theory,
)

LIMITS = Limits(conflicts=200_000, ground_rules=2_000_000)
"""What it may take to find one case."""
MOST_CASES = 300
"""How many cases are looked at: there may be exponentially many conditions."""
_FIRST_STRATEGY = 3
_Names = Mapping[str, str]
"""What constants are called instead."""


class Qualification(NamedTuple):
    """An action of the agent's that has no successor in the states with these literals."""

    action: Action
    body: tuple[Literal, ...]

    def renamed(self, names: _Names) -> Qualification:
        """The same of the actions and fluents that are alike under a renaming of constants."""
        body = tuple(_renamed(literal, names) for literal in self.body)
        return Qualification(_renamed(self.action, names), body)

    @property
    def rule(self) -> str:
        """The rule that says so of every step."""
        body = (f"{'' if f.is_positive else '-'}holds({f.atom},I)" for f in self.body)
        return f"disqualified({self.action},I) :- {', '.join((*body, 'step(I)'))}."


def qualifications(description: Description, program: str) -> Iterator[Qualification]:
    """Conditions that together say in which states an action of the agent's has no successor.

    Every state is looked at, whatever the size of the diagram, but those in which a law says that
    the action is impossible. No literal of a condition can be left out. `program` is the
    translation of the description. Of actions that differ only in constants which no law tells
    apart one is looked at. Raises LimitError behind the conditions that were found, where there are
    more than `MOST_CASES` cases or one takes more than `LIMITS`.
    """
    suspected = suspects(description)
    if not suspected:
        return
    alike = _alike(suspected, interchangeable(*analyse(description.source, description.name)))
    with deciding(LIMITS):
        search = _Search(description, program, alike)
    for _ in range(MOST_CASES):
        with deciding(LIMITS):
            case = search.next()
            if case is None:
                return
            found = search.learn(case)
        if found is not None:
            yield from (found.renamed(names) for names in alike[found.action])
    raise LimitError(f"there are more than {MOST_CASES} cases")


def _alike(
    actions: Iterable[Action], classes: Iterable[Sequence[str]]
) -> dict[Action, list[_Names]]:
    """One of each set of actions that are alike, with the renamings that lead to all of them."""
    class_of = {constant: tuple(own) for own in classes for constant in own}
    found: dict[Action, list[_Names]] = {}
    for action in actions:
        used: dict[tuple[str, ...], list[str]] = {}
        for constant in dict.fromkeys(action.arguments):
            if constant in class_of:
                used.setdefault(class_of[constant], []).append(constant)
        names: dict[str, str] = {}
        for own, constants in used.items():
            rest = (constant for constant in own if constant not in constants)
            names |= dict(zip(own, (*constants, *rest), strict=True))
        back = {name: constant for constant, name in names.items()}
        found.setdefault(_renamed(action, back), []).append(names)
    return found


def _renamed(literal: Literal, names: _Names) -> Literal:
    arguments = (names.get(constant, constant) for constant in literal.arguments)
    return Literal.of(literal.name, arguments, literal.is_positive)


class _Case(NamedTuple):
    """A state and an action without a known successor; literals that are certain of any."""

    state: State
    action: Action
    certain: frozenset[Literal]


class _Search:
    """The cases of a description that neither a condition nor a strategy covers."""

    def __init__(self, description: Description, program: str, suspected: Iterable[Action]) -> None:
        self._found: list[Qualification] = []
        self._description = description
        self._program = program
        self._facts = [*laws(description), *(fact("suspect", action) for action in suspected)]
        self._strategies = _FIRST_STRATEGY
        self._try(())

    @cached_property
    def _transitions(self) -> Transitions:
        return Transitions(self._program, self._description.fluents)

    def next(self) -> _Case | None:
        """One of the cases; None: there is none left. Raises LimitError."""
        model = first_model(self._control)
        if model is None:
            return None
        ((action,),) = select(model, "attempted", 1)
        now, certain = (
            frozenset(map(_literal, chain.from_iterable(select(model, name, 1))))
            for name in ("now", "certain")
        )
        return _Case(frozenset(f for f in now if f.is_positive), literal_of(action), certain)

    def learn(self, case: _Case) -> Qualification | None:
        """Covers a case: by a strategy where there is a successor, else by a condition.

        Raises LimitError.
        """
        outcomes = self._transitions.outcomes(case.state, (case.action,))
        if outcomes:
            after = in_order(outcomes, self._description.fluents)[0]
            self._try(self._given_up(case, after))
            return None
        body = self._transitions.hindrance(case.state, case.action)
        found = Qualification(case.action, body)
        self._found.append(found)
        name = f"condition{len(self._found)}"
        self._control.add(name, [], _excluded(found))
        self._control.ground([(name, [])])
        return found

    def _given_up(self, case: _Case, after: State) -> Iterator[Symbol]:
        """The literals that are given up for a successor, beside those that have to be."""
        for fluent in self._description.fluents:
            opposite = fluent if fluent in after else fluent.complement
            if opposite not in case.certain:
                yield fact("given_up", self._strategies, term(opposite.complement))

    def _try(self, given_up: Iterable[Symbol]) -> None:
        """One more strategy."""
        self._facts += [*given_up, fact("strategy", self._strategies)]
        self._strategies += 1
        texts = [self._program, theory("qualifications"), *map(_excluded, self._found)]
        self._control = ground(texts, {"n": 0}, self._facts)


def _literal(symbol: Symbol) -> Literal:
    """The literal of yes(F) or no(F)."""
    fluent = literal_of(symbol.arguments[0])
    return fluent if symbol.name == "yes" else fluent.complement


def _excluded(known: Qualification) -> str:
    """The constraint by which no further case of a condition is found."""
    body = (f"now({term(each)})" for each in known.body)
    return f":- {', '.join((f'attempted({known.action})', *body))}."
