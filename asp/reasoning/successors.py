"""Successor states: the outcomes of an action, by clingo."""

from collections.abc import Iterable, Sequence

import clingo

from asp.language import Action, Fluent, Literal
from asp.solving import (
    Session,
    State,
    answer_sets,
    assumptions,
    core,
    fact,
    is_satisfiable,
    solving,
    state_of,
)

_CHOOSING = clingo.Function("choosing")


def in_order(states: Iterable[State], fluents: Sequence[Fluent]) -> list[State]:
    """States in the order of the fluents: of two that first in which a fluent is true."""
    return sorted(states, key=lambda state: place_of(state, fluents))


def place_of(state: State, fluents: Sequence[Fluent]) -> list[bool]:
    """A key for the order of states."""
    return [fluent not in state for fluent in fluents]


class Transitions:
    """The transition diagram of a domain, one transition at a time.

    `deterministic` says that every action has one outcome.
    """

    def __init__(
        self, program: str, fluents: Sequence[Fluent], deterministic: bool = False
    ) -> None:
        self.deterministic = deterministic
        self._fluents = tuple(fluents)
        self._session = Session(program, "incremental_transitions", fluents, (), n=1)

    def after(
        self, state: State, attempt: Action | None, reported: tuple[Action, ...]
    ) -> tuple[State, bool] | None:
        """A next state, and whether the attempt took effect; None where nothing fits.

        `attempt` is the agent's action, or None; `reported` are exogenous actions that happened. Of
        several next states it is any.
        """
        session = self._session
        attempted = () if attempt is None else (fact("attempted", attempt),)
        session.switch_on(*attempted, *(fact("reported", event) for event in reported))
        start = session.assume_state(state, 0)
        if start is None:
            return None
        with solving(session.control, start) as model:
            if model is None:
                return None
            took_effect = attempt is not None and session.is_true(model, "occurs", attempt, 0)
            return session.state(model, 1), took_effect

    def all_after(
        self, state: State, attempt: Action | None, reported: tuple[Action, ...]
    ) -> tuple[Sequence[State], bool]:
        """Every next state, in the order of the fluents, and whether the attempt took effect."""
        after = self.after(state, attempt, reported)
        if after is None:
            return (), False
        if self.deterministic:
            return (after[0],), after[1]
        return in_order(self._reached(state), self._fluents), after[1]

    def successors(self, state: State) -> set[State]:
        """The states that actions of the agent's own may lead to. Raises LimitError."""
        self._session.switch_on(_CHOOSING)
        return self._reached(state)

    def outcomes(self, state: State, actions: Iterable[Action]) -> set[State]:
        """The states that actions of the agent's and of others, all at once, may lead to.

        None where they cannot occur together in the state. Raises LimitError.
        """
        self._session.switch_on(*(fact("reported", action) for action in actions))
        return self._reached(state)

    def _reached(self, state: State) -> set[State]:
        start = self._session.assume_state(state, 0)
        if start is None:
            return set()
        found, _ = answer_sets(self._session.control, start)
        return {state_of(shown) for shown in found}

    def hindrance(self, state: State, action: Action) -> tuple[Literal, ...]:
        """Literals of a state that make an action impossible, none of which can be left out.

        Empty if it is possible there, or impossible everywhere. True fluents are preferred. Raises
        LimitError.
        """
        self._session.switch_on(_CHOOSING)
        occurs = self._session.literal("occurs", action, 0)
        if occurs is None:
            return ()
        literals = {
            number if fluent in state else -number: fluent if fluent in state else fluent.complement
            for fluent in self._fluents
            if (number := self._session.holds(fluent, 0)) is not None
        }
        in_order = sorted(literals, key=lambda number: literals[number].is_positive)
        found = core(self._session.control, [occurs], in_order)
        return tuple(sorted(literals[number] for number in found or ()))

    def satisfiable(self, goal: Iterable[Literal]) -> bool:
        """Whether some state satisfies a goal. Raises LimitError."""
        self._session.switch_on()
        wanted = assumptions((self._session.holds(f.atom, 0), f.is_positive) for f in goal)
        return wanted is not None and is_satisfiable(self._session.control, wanted)
