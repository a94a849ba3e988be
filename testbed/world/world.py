"""The transition diagram of a domain (P 3.1.1), and the observations of a state.

`World` is the interface, with all that does not depend on how the laws are kept: the reading of
literals, and the lines that say what is wrong. A backend finds states and transitions.
"""

from abc import ABC, abstractmethod
from collections.abc import Iterable, Iterator
from functools import cached_property, lru_cache
from typing import Any

from asp.language import Action, Description, Facts, Fluent, Literal
from testbed.world.closure import bits
from testbed.world.errors import (
    NotExecutableError,
    StateError,
    UnknownActionError,
    UnknownFluentError,
)

_STATES = 256
"""Of how many states the facts are remembered."""
Law = tuple[tuple[Literal, ...], tuple[Literal, ...]]
"""A head, or the actions that are impossible together, and a body."""


class World(ABC):
    """The states of a description, its transitions, and what a robot sees of a state.

    A state is an integer: bit i is set where the i-th of `fluents` is true. Literals and actions
    may be given as text, `-loc(book1,kitchen)`. A compound action is any iterable of the names of
    actions that happen at once; the empty one is one, too. Every method is a pure function of its
    arguments; the successors asked for last are remembered.

    `facts` are the fluents that are true in a state, for laws that are matched against them.
    `fluents`, `agent_actions` and `exogenous_actions` are in the order of declaration, defined
    fluents behind inertial ones. `description` is the ground description; where the laws are
    matched it is without laws about fluents and actions.
    """

    _arguments: tuple[Any, ...]
    """What the backend's class was called with."""

    def __init__(self, description: Description, remembered: int | None) -> None:
        self.description = description
        self.fluents: tuple[Fluent, ...] = description.fluents
        self.agent_actions: tuple[Action, ...] = description.agent_actions
        self.exogenous_actions: tuple[Action, ...] = description.exogenous_actions
        self._actions: frozenset[str] = frozenset((*self.agent_actions, *self.exogenous_actions))
        self._numbers = {fluent: (n, True) for n, fluent in enumerate(self.fluents)}
        self._numbers |= {fluent.complement: (n, False) for fluent, (n, _) in self._numbers.items()}
        self._remembered = lru_cache(remembered)(self._successors)
        self.facts = lru_cache(_STATES)(lambda state: Facts(self.true_atoms(state)))
        self._needed = tuple(
            (sum(1 << self._numbers[fluent][0] for fluent in some), some)
            for some in description.initially
        )

    def __reduce__(self) -> tuple[Any, ...]:
        """A copy is compiled anew: neither compiled laws nor what is remembered can be pickled."""
        return type(self), self._arguments

    def state(self, literals: Iterable[Literal]) -> int:
        """The initial state of these literals; a fluent left out is false unless it follows.

        Raises StateError where a fluent is unknown, the literals contradict each other or a state
        constraint, describe no or several states, or leave out what an initial state must have.
        """
        given = tuple(literals)
        self.check_together(given)
        states = [state for state in self._completions(given) if self.is_state(state)]
        if len(states) != 1:
            found = "several states agree" if states else "no state of the domain agrees"
            raise StateError(f"{found} with {self._listed(given)}")
        for mask, some in self._needed:
            if not states[0] & mask:
                raise StateError(f"an initial state needs {' or '.join(some)}")
        return states[0]

    def check_together(self, literals: Iterable[Literal]) -> None:
        """Raises StateError where the literals, with all that follows from them, are in no state.

        A sound test that takes no search: what passes it may still be in no state.
        """
        given = tuple(literals)
        try:
            numbered = {self._numbered(literal): literal for literal in given}
        except UnknownFluentError as error:
            raise StateError(str(error)) from None
        twice = [lit for (n, positive), lit in numbered.items() if (n, not positive) in numbered]
        if twice:
            raise StateError(f"contradiction between {self._listed(twice)}")
        broken = self._broken(given)
        if broken is not None:
            (head,), body = broken
            conflict = self._listed((*body, head.complement))
            law = self._if(head, body)
            raise StateError(f"{conflict} cannot be together: the constraint is {law}")

    @abstractmethod
    def is_state(self, state: int) -> bool:
        """Whether the set of true fluents is closed under constraints and definitions."""

    @abstractmethod
    def states(self) -> Iterator[int]:
        """Every state of the domain, in a fixed order; there may be too many to wait for."""

    def initial_states(self) -> tuple[int, ...]:
        """The states that have all that the description asks of an initial one, in that order."""
        return self._initial_states

    def check_begins(self) -> None:
        """Raises StateError where there is no initial state; it looks for the first one."""
        if next(self._initial(), None) is None:
            why = "no state has all that its section 'initially' asks for; change it, or the laws"
            raise StateError(f"has no initial state: {why}")

    @cached_property
    def _initial_states(self) -> tuple[int, ...]:
        return tuple(self._initial())

    def _initial(self) -> Iterator[int]:
        return filter(self.is_initial, self.states())

    def is_initial(self, state: int) -> bool:
        """Whether a state has all that the description asks of an initial one."""
        return all(state & mask for mask, _ in self._needed)

    def bare(self) -> int:
        """A state in which nothing is true but what must be. Raises StateError if there is none."""
        self.check_together(())
        for state in self._completions(()):
            return state
        raise StateError("no state of the domain has only what must be true")

    @abstractmethod
    def adjusted(self, state: int, literals: Iterable[Literal]) -> tuple[int, ...]:
        """The states in which the literals hold, and else what holds in the given one if it can.

        Sorted; none where the literals are in no state. Raises UnknownFluentError.
        """

    def literals(self, state: int) -> tuple[Literal, ...]:
        """Every fluent of the state as a literal, in the order of the fluents."""
        return tuple(
            fluent if state >> number & 1 else fluent.complement
            for number, fluent in enumerate(self.fluents)
        )

    def true_atoms(self, state: int) -> tuple[Fluent, ...]:
        """The fluents that are true in the state, in their order."""
        return tuple(self.fluents[number] for number in bits(state))

    def holds(self, state: int, literal: Literal) -> bool:
        """Whether the literal holds. Raises UnknownFluentError."""
        return self.satisfies(state, (literal,))

    def satisfies(self, state: int, literals: Iterable[Literal]) -> bool:
        """Whether all the literals hold. Raises UnknownFluentError."""
        numbered = [*map(self._numbered, literals)]  # all of them: each may be unknown
        return all(bool(state >> number & 1) == positive for number, positive in numbered)

    def successors(self, state: int, actions: Iterable[Action]) -> tuple[int, ...]:
        """Every state the compound action can lead to, sorted; none: it cannot be executed.

        Raises UnknownActionError.
        """
        return self._remembered(state, frozenset(actions))

    def moves(self, state: int, beside: Iterable[Action] = ()) -> Iterator[tuple[Action, int]]:
        """Each action of the agents that can be executed, with each state it can lead to.

        In the order of declaration, together with what happens `beside` it. Nothing is remembered:
        this is for searches, whose memory would grow with all actions of every state.
        """
        others = frozenset(beside)
        for action in self.agent_actions:
            for reached in self._successors(state, others | {action}):
                yield action, reached

    def successor(self, state: int, actions: Iterable[Action]) -> int:
        """The one successor. Raises NotExecutableError, or ValueError where there are several."""
        compound = frozenset(actions)
        found = self.successors(state, compound)
        if not found:
            raise NotExecutableError(self.why_not(state, compound))
        if len(found) > 1:
            outcomes = " | ".join(" ".join(self.true_atoms(s)) for s in found)
            raise ValueError(f"{', '.join(sorted(compound))} has several outcomes: {outcomes}")
        return found[0]

    def executable(self, state: int, actions: Iterable[Action]) -> bool:
        """Whether the compound action has a successor. Raises UnknownActionError."""
        return bool(self.successors(state, actions))

    def why_not(self, state: int, actions: Iterable[Action]) -> str | None:
        """One line that says why the compound action cannot be executed; None if it can.

        Raises UnknownActionError.
        """
        compound = frozenset(actions)
        if self.executable(state, compound):
            return None
        law = next(self.forbidding(state, compound), None)
        if law is None:
            return f"the effects of {', '.join(sorted(compound))} contradict each other"
        return self._if(f"impossible {', '.join(sorted(law[0]))}", law[1])

    def forbidding(self, state: int, actions: Iterable[Action]) -> Iterator[Law]:
        """The laws that make a compound action impossible in a state, as they are declared.

        Raises UnknownActionError.
        """
        return self._forbidding(state, self._known(actions))

    def visible(self, state: int, robot: str) -> tuple[Literal, ...]:
        """The literals that the robot sees in the state, in the order of the fluents."""
        seen = ((number, self.fluents[number]) for number in bits(self._seen(state, robot)))
        return tuple(fluent if state >> n & 1 else fluent.complement for n, fluent in seen)

    @abstractmethod
    def _completions(self, literals: tuple[Literal, ...]) -> Iterable[int]:
        """What the literals can be completed to where the rest is false unless it follows."""

    @abstractmethod
    def _broken(self, literals: tuple[Literal, ...]) -> Law | None:
        """A constraint that the literals break together with all that follows from them."""

    @abstractmethod
    def _transitions(self, state: int, compound: frozenset[Action]) -> tuple[int, ...]:
        """The successors of a compound action of known actions, sorted."""

    @abstractmethod
    def _forbidding(self, state: int, compound: frozenset[Action]) -> Iterator[Law]:
        """The laws that make the compound action impossible, as they are declared."""

    @abstractmethod
    def _seen(self, state: int, robot: str) -> int:
        """The fluents of which the robot sees whether they hold, one bit each."""

    def _successors(self, state: int, compound: frozenset[Action]) -> tuple[int, ...]:
        return self._transitions(state, self._known(compound))

    def _known(self, actions: Iterable[Action]) -> frozenset[Action]:
        """The compound action. Raises UnknownActionError."""
        compound = frozenset(actions)
        unknown = sorted(compound - self._actions)
        if unknown:
            name = self.description.name
            raise UnknownActionError(f"{unknown[0]} is not an action of the domain {name}")
        return compound

    def _numbered(self, literal: Literal) -> tuple[int, bool]:
        """The number of a literal's fluent, and its sign. Raises UnknownFluentError."""
        try:
            return self._numbers[literal]
        except (KeyError, TypeError):
            atom = str(literal).removeprefix("-")
            raise UnknownFluentError(f"{atom} is not a fluent of the domain") from None

    def _listed(self, literals: Iterable[Literal]) -> str:
        """The literals in the order of the fluents, of a pair the positive one first."""
        ordered = sorted({(n, not positive) for n, positive in map(self._numbered, literals)})
        return ", ".join("-" * negative + self.fluents[n] for n, negative in ordered)

    def _if(self, head: str, body: Iterable[Literal]) -> str:
        return f"{head} if {self._listed(body)}".removesuffix(" if ")
