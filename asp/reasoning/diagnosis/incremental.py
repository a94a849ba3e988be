"""Smallest explanations of a history: exceptions to defaults, events that nobody reported."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass, replace

from clingo import Symbol

from asp.reasoning.diagnosis.encoding import (
    Account,
    Assumed,
    Past,
    account,
    assumed,
    assumptions,
    externals,
    observations,
)
from asp.solving import (
    Recent,
    Session,
    answer_sets,
    goal_externals,
    is_satisfiable,
    preferring,
    theory,
)

_FIRST_HORIZON = 16
_FEW, _MANY = 4, 16
_MOST_CONTROLS = 4


class Explanations:
    """The smallest explanations in one domain; the horizon doubles where a history outgrows it.

    A control counts events up to a number. Most explanations are of a few, for which a small
    control is kept; one that counts further is grounded when they do not suffice.
    """

    def __init__(
        self,
        program: str,
        fluents: Sequence[str],
        events: Sequence[str],
        defaults: Sequence[str],
        ranks: Iterable[Symbol],
    ) -> None:
        """`ranks` are the facts that `order.lp` and `defaults.lp` are given from outside."""
        self._program = "\n".join([program, theory("defaults"), theory("order")])
        self._fluents = fluents
        self._events = events
        self._defaults = defaults
        self._ranks = tuple(ranks)
        self._controls: Recent[tuple[int, int], Session] = Recent(_MOST_CONTROLS)

    def smallest(self, past: Past, fewest: tuple[int, int] = (0, 0)) -> Account | None:
        """The first of the smallest explanations of the past.

        None has fewer events and distrusted reports than the first number of `fewest`, or as many
        and fewer exceptions than the second. None stands for "more events than are counted, or no
        explanation at all", which is left to the theory itself.
        """
        tried = fewest[0]
        for most in (_FEW, _MANY):
            question = self._question(past, most)
            if question.possible and tried <= most:
                for events in range(tried, most + 1):
                    least = fewest[1] if events == fewest[0] else 0
                    for exceptions in range(least, len(self._defaults) + 1):
                        found = self._first(question, events, exceptions)
                        if found is not None:
                            return found
            tried = max(tried, most + 1)
        return None

    def keeping(self, past: Past, adopted: Assumed) -> Account | None:
        """The first account with exactly this explanation; None: there is none, or it is long."""
        question = self._question(past, _FEW if adopted.size <= _FEW else _MANY)
        kept = question.kept
        events = [kept.literal("unobserved", name, step) for step, name in adopted.events]
        events += [kept.literal("distrusted", name, step) for step, name in adopted.distrusted]
        exceptions = [kept.literal("exception", name) for name in adopted.exceptions]
        exactly = assumptions((literal, True) for literal in (*events, *exceptions))
        if question.given is None or exactly is None or len(events) > question.most:
            return None
        question = replace(question, given=question.given + exactly)
        return self._first(question, len(events), len(exceptions))

    def alternatives(
        self, past: Past, size: tuple[int, int], most: int
    ) -> tuple[list[Assumed], bool]:
        """Explanations of the past with so many events and distrusted reports, and exceptions.

        With them, whether there are more than `most`; True also where the control cannot tell. If
        `size` is the smallest, these are all smallest explanations.
        """
        question = self._question(past, _FEW if size[0] <= _FEW else _MANY)
        limited = question.at_most(*size)
        if limited is None or size[0] > question.most:
            return [], True
        found, more = answer_sets(question.kept.control, limited, most)
        return [assumed(shown) for shown in found], more

    def _question(self, past: Past, most: int) -> _Question:
        """The control that counts so far, with the past's externals, and what was observed."""
        kept = self._reaching(past.step, most)
        kept.switch_on(*goal_externals(past.goal), *externals(past))
        return _Question(kept, most, past, observations(kept, past))

    def _first(self, question: _Question, events: int, exceptions: int) -> Account | None:
        """The preferred explanation with at most so many events and exactly so many exceptions."""
        limited = question.at_most(events, exceptions)
        if limited is None:
            return None
        kept = question.kept
        with preferring(kept.control, limited) as model:
            if model is None:
                return None
            return account(kept, model, question.past, self._events, self._defaults)

    def _reaching(self, step: int, most: int) -> Session:
        # It depends on the history alone, so that budgets do not depend on earlier histories.
        horizon = _FIRST_HORIZON
        while horizon < step:
            horizon *= 2
        return self._controls.get((horizon, most), lambda: self._made(horizon, most))

    def _made(self, horizon: int, most: int) -> Session:
        return Session(
            self._program, "incremental_diagnosis", self._fluents, self._ranks, n=horizon, most=most
        )


@dataclass(frozen=True)
class _Question:
    """A control switched to a past, and assumptions for everything observed."""

    kept: Session
    most: int
    past: Past
    given: list[int] | None

    @property
    def possible(self) -> bool:
        """Whether any explanation has at most as many events as are counted."""
        if self.most == _FEW:
            return self.given is not None  # found out while they are counted
        return self.given is not None and is_satisfiable(self.kept.control, self.given)

    def at_most(self, events: int, exceptions: int) -> list[int] | None:
        """Assumptions for at most so many events, exactly so many exceptions; None: impossible."""
        kept = self.kept
        more = kept.literal("count", self.past.step, events + 1) if events < self.most else None
        number = kept.literal("number_exceptions", exceptions)
        if self.given is None or number is None:
            return None
        return [*self.given, number] if more is None else [*self.given, number, -more]
