"""What an action leads to."""

from collections.abc import Iterable, Sequence
from dataclasses import dataclass

import clingo
from clingo import Symbol

from asp.language import Action, Fluent, Literal
from asp.solving import Session, State, answer_sets, core, fact, is_satisfiable, literal_of, solving

MOST_ASSUMED = 6
"""How many unobserved events and distrusted reports are assumed of one step at most."""

_BRANCHING, _CHOOSING, _PAST, _FAILING = map(
    clingo.Function, ("branching", "choosing", "past", "failing")
)


@dataclass(frozen=True)
class Branch:
    """A transition, with the unobserved events and the distrusted statements that it assumes."""

    state: State
    took_effect: bool
    events: tuple[Action, ...]
    distrusted: tuple[Action, ...]

    @property
    def size(self) -> int:
        return len(self.events) + len(self.distrusted)


class Transitions:
    """The transition diagram of a domain, one transition at a time."""

    def __init__(self, program: str, fluents: Sequence[Fluent], ranks: Iterable[Symbol]) -> None:
        self._fluents = tuple(fluents)
        self._session = Session(
            program, "incremental_transitions", fluents, ranks, n=1, most=MOST_ASSUMED + 1
        )

    def after(
        self, state: State, attempt: Action | None, reported: tuple[Action, ...]
    ) -> tuple[State, bool] | None:
        """The next state, and whether the attempt took effect; None where nothing fits.

        `attempt` is the agent's action, or None; `reported` are exogenous actions that happened.
        """
        session = self._session
        session.switch_on(*_actions(attempt, reported))
        assumptions = session.assume_state(state, 0)
        if assumptions is None:
            return None
        happened = None if attempt is None else session.literal("occurs", attempt, 0)
        with solving(session.control, assumptions) as model:
            if model is None:
                return None
            return session.state(model, 1), happened is not None and model.is_true(happened)

    def branches(
        self,
        state: State,
        attempt: Action | None,
        reported: tuple[Action, ...],
        size: int,
        most: int,
        failing: bool = False,
    ) -> list[Branch] | None:
        """Every transition with at most `size` events that nobody reported and distrusted reports.

        The attempt, where it is `failing`, may be distrusted, too: it was not executed. With `size`
        -1 nothing may have happened at all: reports are distrusted, whatever their number. None
        where there are more than `most`, or `size` is above MOST_ASSUMED.
        """
        session = self._session
        if size > MOST_ASSUMED:
            return None
        switches = [_BRANCHING, *([_PAST] if size >= 0 else []), *([_FAILING] if failing else [])]
        session.switch_on(*switches, *_actions(attempt, reported))
        assumptions = session.assume_state(state, 0)
        if assumptions is None:
            return []
        more = None if size < 0 else session.literal("more", size + 1)
        limited = assumptions if more is None else [*assumptions, -more]
        found, left_off = answer_sets(session.control, limited, most)
        return None if left_off else [_branch(shown) for shown in found]

    def successors(self, state: State) -> set[State]:
        """The states that actions of the agent's own may lead to. Raises LimitError."""
        self._session.switch_on(_CHOOSING)
        assumptions = self._session.assume_state(state, 0)
        if assumptions is None:
            return set()
        found, _ = answer_sets(self._session.control, assumptions)
        return {_branch(shown).state for shown in found}

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
        wanted = [(self._session.holds(each.atom, 0), each.is_positive) for each in goal]
        if any(number is None and truth for number, truth in wanted):
            return False
        assumed = [number if truth else -number for number, truth in wanted if number is not None]
        return is_satisfiable(self._session.control, assumed)


def _actions(attempt: Action | None, reported: tuple[Action, ...]) -> list[Symbol]:
    actions = [fact("reported", event) for event in reported]
    return actions if attempt is None else [*actions, fact("attempted", attempt)]


def _branch(shown: Sequence[Symbol]) -> Branch:
    def of(predicate: str) -> tuple[Literal, ...]:
        return tuple(literal_of(s.arguments[0]) for s in shown if s.match(predicate, 1))

    took_effect = any(symbol.match("took_effect", 0) for symbol in shown)
    return Branch(frozenset(of("next")), took_effect, of("unobserved"), of("distrusted"))
