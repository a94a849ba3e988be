"""The smallest explanations of a history by their definition: every set of events is tried."""

from collections.abc import Iterable, Iterator, Sequence
from itertools import chain, combinations
from typing import NamedTuple

from asp import Step
from asp.language import Literal
from asp.reasoning.diagnosis import Explanation, Happening
from benchmarks.descriptions.definition import Definition, Goal, State

Events = frozenset[Happening]


class Account(NamedTuple):
    """How a history may have begun, and what else is assumed of it."""

    initial: State
    unobserved: Events = frozenset()
    distrusted: Events = frozenset()


class Explaining:
    """Histories in one description, which may tell of a goal."""

    def __init__(self, definition: Definition, goal: Goal = ()) -> None:
        self._definition = definition
        self._goal = goal

    def smallest(self, history: Sequence[Step], most: int) -> list[Explanation] | None:
        """Every smallest explanation, the first in the stated order at the front.

        None where the smallest ones assume more than `most` events; empty where nothing explains
        the history.
        """
        for size in range(most + 1):
            accounts = self._accounts(history, size)
            if accounts:
                every = [self._explanation(account, history[0]) for account in accounts]
                fewest = min(len(each.exceptions) for each in every)
                good = [each for each in every if len(each.exceptions) == fewest]
                return sorted(good, key=lambda each: self._place(each, len(history)))
        return None if self._is_consistent(history) else []

    def _accounts(self, history: Sequence[Step], size: int) -> set[Account]:
        """Those with at most so many assumptions about what happened."""
        now = {state: {Account(state)} for state in self._definition.initial}
        for time, step in enumerate(history):
            now = {s: found for s, found in now.items() if self._agrees(s, step)}
            if time == len(history) - 1 and not acting(step):
                break
            then: dict[State, set[Account]] = {}
            for state, accounts in now.items():
                for unobserved, distrusted, after in self._outcomes(state, step, time, size):
                    longer = (
                        one._replace(
                            unobserved=one.unobserved | unobserved,
                            distrusted=one.distrusted | distrusted,
                        )
                        for one in accounts
                    )
                    then.setdefault(after, set()).update(
                        one for one in longer if len(one.unobserved) + len(one.distrusted) <= size
                    )
            now = then
        return set().union(*now.values())

    def _is_consistent(self, history: Sequence[Step]) -> bool:
        """Whether any number of events explains a history."""
        now = set(self._definition.initial)
        for time, step in enumerate(history):
            now = {state for state in now if self._agrees(state, step)}
            if time < len(history) - 1 or acting(step):
                now = {
                    after
                    for state in now
                    for *_, after in self._outcomes(state, step, time, len(self._definition.others))
                }
        return bool(now)

    def _agrees(self, state: State, step: Step) -> bool:
        holds = self._definition.satisfies(state, self._goal)
        return self._definition.satisfies(state, step.observed) and step.goal in (None, holds)

    def _outcomes(
        self, state: State, step: Step, time: int, size: int
    ) -> Iterator[tuple[Events, Events, State]]:
        """What may be assumed of a step in a state, and the states that it leads to."""
        known = self._definition
        own = {step.attempted} if step.attempted else set[str]()
        if own:
            took_effect = bool(known.after(state, frozenset(own)))
            if took_effect != step.took_effect:
                return
            own = own if took_effect else set()
        free = [event for event in known.others if event not in step.reported]
        for unobserved in _subsets(free, size):
            for distrusted in _subsets(step.reported, size - len(unobserved)):
                happened = {*own, *unobserved, *step.reported} - {*distrusted}
                for after in known.after(state, frozenset(happened)):
                    yield _at(time, unobserved), _at(time, distrusted), after

    def _explanation(self, account: Account, start: Step) -> Explanation:
        known, initial = self._definition, account.initial
        observed = {each.removeprefix("-") for each in start.observed}
        unknown = [fluent for fluent in known.inertial if fluent not in observed]
        return Explanation(
            tuple(sorted(account.unobserved)),
            tuple(sorted(account.distrusted)),
            tuple(sorted(known.exceptions(initial))),
            tuple(sorted(Literal.parse(f if f in initial else f"-{f}") for f in unknown)),
        )

    def _place(self, explanation: Explanation, steps: int) -> tuple[list[bool], ...]:
        """The place in the order of `docs/theory.md`, what is decided first at the front."""
        known = self._definition
        events = [h for t in reversed(range(steps)) for e in known.others for h in _at(t, [e])]
        return (
            [each in explanation.distrusted for each in events],
            [each in explanation.exceptions for each in known.defaults],
            [each in explanation.initial for each in reversed(known.inertial)],
            [each not in explanation.unobserved for each in events],
        )


def acting(step: Step) -> bool:
    """Whether anything is said to have happened after the state of a step."""
    return bool(step.attempted or step.reported)


def _at(time: int, actions: Iterable[str]) -> Events:
    return frozenset(Happening(time, Literal.parse(action)) for action in actions)


def _subsets(actions: Sequence[str], most: int) -> Iterator[tuple[str, ...]]:
    return chain.from_iterable(combinations(actions, n) for n in range(most + 1))
