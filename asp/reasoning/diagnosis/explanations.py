"""Explanations of histories (D 2.4): their assumptions, and the interface of a diagnoser."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Callable, Iterable, Iterator, Mapping
from dataclasses import dataclass, field, replace
from typing import Protocol, TypeVar

from clingo import Symbol

from asp.language import Action, Literal
from asp.reasoning.diagnosis.history import Happening, History, Record
from asp.solving import fact, literal_of


@dataclass(frozen=True)
class Explanation:
    """What makes a history consistent: exogenous events that nobody reported, and how it began.

    `distrusted` are reports of events that did not happen, and attempts that were not executed;
    `exceptions` are names of the domain's defaults, `initial` literals of the inertial fluents of
    which nothing was observed at step 0. All are sorted. `proved` says whether it is known that no
    explanation is smaller.
    """

    unobserved: tuple[Happening, ...] = ()
    distrusted: tuple[Happening, ...] = ()
    exceptions: tuple[str, ...] = ()
    initial: tuple[Literal, ...] = ()
    proved: bool = field(default=True, compare=False)

    @property
    def size(self) -> int:
        """How many events, and false reports and attempts, it assumes (27)."""
        return len(self.unobserved) + len(self.distrusted)

    @property
    def price(self) -> tuple[int, int]:
        """How much it assumes: its size, and then its exceptions."""
        return self.size, len(self.exceptions)

    def facts(self, predicate: str) -> Iterator[Symbol]:
        """predicate(PEA,I) for each event, and predicate_distrusted(A,I) for what is distrusted.

        Also predicate_exception(D), predicate_initial(F,B).
        """
        yield from (fact(predicate, action, step) for step, action in self.unobserved)
        yield from (fact(f"{predicate}_distrusted", a, step) for step, a in self.distrusted)
        yield from (fact(f"{predicate}_exception", default) for default in self.exceptions)
        for literal in self.initial:
            truth = "true" if literal.is_positive else "false"
            yield fact(f"{predicate}_initial", literal.atom, truth)

    def happened(self, record: Record, step: int) -> tuple[Action, ...]:
        """The exogenous actions of a step that has this record."""
        trusted = (e for e in record.reported if (step, e) not in self.distrusted)
        return (*trusted, *(event.action for event in self.unobserved if event.step == step))

    def executed(self, record: Record, step: int) -> Action | None:
        """The agent's action of a step that has this record; None where none was executed."""
        action = record.attempt[0] if record.attempt else None
        return None if (step, action) in self.distrusted else action

    def left(self, history: History) -> Explanation:
        """What is left to assume of it where some of its events were reported since."""
        unobserved = (e for e in self.unobserved if not history.at(e.step).happened.get(e.action))
        return replace(self, unobserved=tuple(unobserved))

    @property
    def without_start(self) -> Explanation:
        """The same, whatever it says of unknown fluents at step 0."""
        return replace(self, initial=())


def explanation_of(shown: Iterable[Symbol], proved: bool = True) -> Explanation:
    """The explanation that the shown atoms of an answer set are."""
    found: defaultdict[str, list[list[Symbol]]] = defaultdict(list)
    for symbol in shown:
        found[symbol.name].append(symbol.arguments)
    unobserved, distrusted = (
        tuple(sorted(Happening(step.number, literal_of(action)) for action, step in found[name]))
        for name in ("unobserved", "distrusted")
    )
    exceptions = sorted(str(default) for (default,) in found["exception"])
    known = ((literal_of(fluent), truth.name == "true") for fluent, truth in found["initial"])
    initial = sorted(fluent if truth else fluent.complement for fluent, truth in known)
    is_smallest = proved or not (unobserved or distrusted or exceptions)
    return Explanation(unobserved, distrusted, tuple(exceptions), tuple(initial), is_smallest)


Alternatives = tuple[list[Explanation], bool]
"""Explanations of one size, and whether there are more than were asked for."""


@dataclass(frozen=True)
class Diagnosis:
    """An explanation of a history, and the indices of active activities, by name.

    `alternatives` gives at most so many explanations of the same size, and whether there are more;
    where it is None they have to be looked for.
    """

    explanation: Explanation
    indices: Mapping[int, int] = field(default_factory=dict)
    alternatives: Callable[[int], Alternatives] | None = field(
        default=None, compare=False, repr=False
    )


class InconsistentHistoryError(Exception):
    """No exceptions to defaults and no exogenous actions explain what was observed."""


H_contra = TypeVar("H_contra", bound=History, contravariant=True)


class Diagnoser(Protocol[H_contra]):
    """Explains one history after another step of it: the reference, or its incremental twin."""

    def diagnose(self, history: H_contra, adopted: Explanation, /) -> Diagnosis:
        """The adopted explanation if it is still as small as any, else the first smallest one.

        The order is that of `order.lp`. Raises InconsistentHistoryError and LimitError.
        """
