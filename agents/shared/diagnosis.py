"""Phase one: the smallest explanation of a history (spec 2, (25)-(27))."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass

import clingo
from clingo import Symbol

from agents.shared.history import Diagnosis, History
from asp.solving import fact, first_model, ground, select, theory
from testbed.link.messages import Event

_KEEP = clingo.Function("keep")
_FIRST_TRY = 4


class InconsistentHistoryError(RuntimeError):
    """No set of exogenous actions explains what was observed."""


@dataclass(frozen=True)
class Explained:
    """A diagnosis, whether it is the one held before, and the indices of active activities."""

    diagnosis: Diagnosis
    kept: bool
    indices: Mapping[int, int]


def diagnose(
    texts: Iterable[str],
    constants: Mapping[str, int],
    facts: Iterable[Symbol],
    history: History,
    adopted: Diagnosis,
) -> Explained:
    """Explains the history up to its step; `texts` are the theories besides diagnosis itself.

    The adopted diagnosis is kept if it still explains everything; else the first one, in the
    stated order, with the fewest unobserved events. Raises InconsistentHistoryError.
    """
    given = [*facts, fact("explaining", history.step), *adopted.facts("adopted")]
    programs = [*texts, theory("diagnosis")]
    for most in _limits(len(adopted.unobserved), history.step):
        control = ground(programs, {**constants, "max_unobserved": most}, given)
        control.assign_external(_KEEP, True)
        model = first_model(control)
        if model is not None:
            return _explained(model, kept=True)
        control.assign_external(_KEEP, False)
        for number in range(most + 1):
            model = first_model(control, [(fact("number_unobserved", number, history.step), True)])
            if model is not None:
                return _explained(model, kept=False)
    raise InconsistentHistoryError(f"nothing explains the observations up to step {history.step}")


def _limits(adopted: int, step: int) -> Iterator[int]:
    """Ever larger numbers of events to try; more than one a step is never needed twice over."""
    most = max(_FIRST_TRY, adopted)
    while True:
        yield most
        if most >= 2 * step:
            return
        most *= 4


def _explained(model: tuple[Symbol, ...], kept: bool) -> Explained:
    events = sorted((step.number, str(action)) for action, step in select(model, "unobserved", 2))
    unobserved = tuple(Event(step=step, action=action) for step, action in events)
    indices = {name.number: index.number for name, index in select(model, "index", 2)}
    return Explained(Diagnosis(unobserved), kept, indices)
