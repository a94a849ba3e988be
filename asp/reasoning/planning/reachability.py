"""Goals that no plan of any length achieves."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator

from clingo import Symbol

from asp.language import Causal, Constraint, Description, atom, is_positive
from asp.solving import (
    Answers,
    Session,
    State,
    answer_sets,
    core,
    fact,
    ground,
    is_satisfiable,
    theory,
)

_MOST_STATES = 2_000

Searched = Callable[[State, tuple[str, ...]], bool | None]
"""Whether a state that satisfies a goal can be reached; None: not known."""

MOST_ANSWERS, MOST_ORIGINS = 1_000, 16
"""How many answers are remembered, and of how many states what can be reached from there."""


class Reachability:
    """Proves that a goal is out of reach of the agent's own actions, or in reach, where it can.

    It is out of reach if no state satisfies it, or if one of its literals can never become true
    even where laws ask for no more than each condition by itself. Else every state that can be
    reached is looked at: by a search where there is one, else one by one, where
    nothing is said of a state with more than some thousand of those.
    """

    def __init__(self, description: Description, program: str, searched: Searched) -> None:
        """`program` is the description's translation, `searched` an answer by search, if any."""
        self._fluents = description.fluents
        self._laws = list(_laws(description))
        self._program = program
        self._searched = searched
        self._kept: Session | None = None
        self._answers: Answers[tuple[State, tuple[str, ...]], bool | None] = Answers(MOST_ANSWERS)
        self._all_from: Answers[State, frozenset[State] | None] = Answers(MOST_ORIGINS)

    def out_of_reach(self, state: State, goal: tuple[str, ...]) -> bool:
        """Whether it is proved that no plan leads from the state to the goal.

        Raises LimitError.
        """
        return self.reachable(state, goal) is False

    def reachable(self, state: State, goal: tuple[str, ...]) -> bool | None:
        """Whether some plan, of any length, leads from the state to the goal; None: not known.

        Raises LimitError.
        """
        return self._answers.get((state, goal), lambda: self._decide(state, goal))

    def _decide(self, state: State, goal: tuple[str, ...]) -> bool | None:
        if self._contradictory(goal) or self._relaxed(state, goal):
            return False
        return self._looked(state, goal)

    def hindrance(self, state: State, action: str) -> tuple[str, ...]:
        """Literals of a state that make an action impossible, none of which can be left out.

        Empty if it is possible there, or impossible everywhere. True fluents are preferred.
        """
        occurs = self._control.literal("occurs", action, 0)
        if occurs is None:
            return ()
        literals = {
            number if fluent in state else -number: fluent if fluent in state else f"-{fluent}"
            for fluent in self._fluents
            if (number := self._control.holds(fluent, 0)) is not None
        }
        in_order = sorted(literals, key=lambda number: is_positive(literals[number]))
        found = core(self._control.control, [occurs], in_order)
        return tuple(sorted(literals[number] for number in found or ()))

    def _contradictory(self, goal: tuple[str, ...]) -> bool:
        literals = [
            (self._control.holds(atom(literal), 0), is_positive(literal)) for literal in goal
        ]
        if any(number is None and truth for number, truth in literals):
            return True
        assumed = [number if truth else -number for number, truth in literals if number is not None]
        return not is_satisfiable(self._control.control, assumed)

    def _relaxed(self, state: State, goal: tuple[str, ...]) -> bool:
        facts = [fact("wanted", _term(literal)) for literal in goal]
        facts += (
            fact("initially", _term(fluent if fluent in state else f"-{fluent}"))
            for fluent in self._fluents
        )
        found, _ = answer_sets(ground([theory("reach")], {}, [*self._laws, *facts]), most=1)
        return any(shown for shown in found)

    def _looked(self, state: State, goal: tuple[str, ...]) -> bool | None:
        reachable = self._searched(state, goal)
        if reachable is not None:
            return reachable
        states = self._all_from.get(state, lambda: self._explore(state))
        return (
            None
            if states is None
            else any(
                all((atom(literal) in other) == is_positive(literal) for literal in goal)
                for other in states
            )
        )

    def _explore(self, state: State) -> frozenset[State] | None:
        """Every state that can be reached; None where these are too many."""
        found, left = {state}, [state]
        while left:
            new = self._successors(left.pop()) - found
            found |= new
            left += new
            if len(found) > _MOST_STATES:
                return None
        return frozenset(found)

    def _successors(self, state: State) -> set[State]:
        assumptions = self._control.assume_state(state, 0)
        if assumptions is None:
            return set()
        found, _ = answer_sets(self._control.control, assumptions)
        return {frozenset(str(shown.arguments[0]) for shown in answer) for answer in found}

    @property
    def _control(self) -> Session:
        if self._kept is None:
            self._kept = Session(
                self._program, "incremental_transitions", self._fluents, (), ["successors"], n=1
            )
        return self._kept


def _laws(description: Description) -> Iterator[Symbol]:
    for fluent in description.fluents:
        yield fact("fluent", fluent)
    for fluent in description.defined:
        yield fact("defined", fluent)
    laws: list[Causal | Constraint] = [*description.causal, *description.constraints]
    for number, law in enumerate(laws):
        yield fact("law", number, _term(law.head))
        yield from _conditions("needs", number, law.body)
    own = frozenset(description.agent_actions)
    for number, causal in enumerate(description.causal):
        # What others do is no part of a plan: their laws have an action that cannot occur.
        yield fact("causes", causal.action if causal.action in own else "nobody", number)
    yield fact("hinders", -1, "nobody")
    for number, condition in enumerate(description.executability):
        for action in condition.actions if len(condition.actions) == 1 else ():
            yield fact("hinders", number, action)
            yield from _conditions("while", number, condition.body)


def _conditions(predicate: str, number: int, body: Iterable[str]) -> Iterator[Symbol]:
    return (fact(predicate, number, _term(literal)) for literal in body)


def _term(literal: str) -> Symbol:
    return fact("yes" if is_positive(literal) else "no", atom(literal))
