"""Phase one: the smallest explanation of a history (D 2.4, (25)-(27), and P 3.1.2)."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field

import clingo
from clingo import Symbol

from agents.shared.anytime import Search
from agents.shared.history import Diagnosis, History
from agents.shared.limits import SEARCH
from asp.reasoning.diagnosis import Assumed, cannot_hold, conflict
from asp.solving import BudgetError, current, fact, ground, preferring, select, theory, up_to
from testbed.protocol import Event, RobotStops

_KEEP = clingo.Function("keep")
_KEEP_INITIAL = clingo.Function("keep_initial")
_FIRST_TRY = 4
_ROOM = 16


class InconsistentHistoryError(RobotStops):
    """No exceptions to defaults and no exogenous actions explain what was observed."""


@dataclass(frozen=True)
class Explained:
    """A diagnosis, whether it is the one held before, and the indices of active activities.

    `others` gives at most so many explanations of the same size, and whether there are more; where
    it is None they have to be looked for.
    """

    diagnosis: Diagnosis
    kept: bool
    indices: Mapping[int, int]
    others: Callable[[int], tuple[list[Assumed], bool]] | None = field(
        default=None, compare=False, repr=False
    )


def diagnose(
    texts: Iterable[str],
    constants: Mapping[str, int],
    facts: Iterable[Symbol],
    history: History,
    adopted: Diagnosis,
    keeps: bool = True,
) -> Explained:
    """Explains the history up to its step; `texts` are the domain, and theories besides diagnosis.

    The adopted diagnosis is kept, where `keeps`, if it still explains everything, at least its
    events and exceptions; else the first one, in the stated order, with the fewest unobserved
    events and then the fewest exceptions to defaults. Where the budget of the decision does not
    suffice for that it is the best one found, which is not `proved`. Raises
    InconsistentHistoryError and LimitError.
    """
    given = [*facts, fact("explaining", history.step), *adopted.facts("adopted")]
    programs = [*texts, theory("defaults"), theory("order"), theory("diagnosis")]
    step, size = history.step, adopted.size

    def counting(most: int) -> clingo.Control:
        return ground(programs, {**constants, "max_unobserved": most}, given)

    def smallest(most: int) -> Explained | None:
        control = counting(most)
        return (_kept(control) if keeps else None) or _smallest(control)

    try:
        with up_to(SEARCH):
            current().check_conflicts()
            if history.has_doubts:  # where some are wrong no number of events need be tried
                _check(programs[0], given, step)
            limits = event_limits(programs[0], given, step, size)
            return next(filter(None, map(smallest, limits)))
    except BudgetError:
        pass
    for most in room_for_events(given, step, size + _ROOM):
        found = Search(counting(most), adopted, step).best()
        if found is not None:
            return explained_by(found, kept=False, proved=False)
    raise _nothing_explains(step)


def room_for_events(facts: Iterable[Symbol], step: int, first: int) -> Iterator[int]:
    """Ever larger numbers of events, up to all that can have occurred before the step."""
    possible = step * sum(symbol.match("rank", 2) for symbol in facts)
    while first < possible:
        yield first
        first *= 4
    yield possible


def event_limits(program: str, facts: Sequence[Symbol], step: int, adopted: int) -> Iterator[int]:
    """Ever larger numbers of unobserved events to try on a history up to `step`.

    `program` is the domain; an explanation of `adopted` events is within the first limit.

    Raises:
        InconsistentHistoryError: instead of the next number, if no number suffices.
    """
    for most in room_for_events(facts, step, max(_FIRST_TRY, adopted)):
        yield most
        _check(program, facts, step)
    raise _nothing_explains(step)


def _nothing_explains(step: int) -> InconsistentHistoryError:
    return InconsistentHistoryError(f"nothing explains the observations up to step {step}")


def _check(program: str, facts: Sequence[Symbol], step: int) -> None:
    """Raises InconsistentHistoryError if no number of events explains a history."""
    found = conflict(program, facts, step)
    if found is not None:
        raise InconsistentHistoryError(f"inconsistent history: {cannot_hold(found)}")


def _kept(control: clingo.Control) -> Explained | None:
    """The adopted explanation, with what was assumed of the initial state if that is possible."""
    for initial in (True, False):
        control.assign_external(_KEEP, True)
        control.assign_external(_KEEP_INITIAL, initial)
        explained = _preferred(control, (), kept=initial)
        control.assign_external(_KEEP, False)
        control.assign_external(_KEEP_INITIAL, False)
        if explained is not None:
            return explained
    return None


def _smallest(control: clingo.Control) -> Explained | None:
    """As few unobserved events as possible, and then as few exceptions to defaults."""
    for events in _atoms(control, "number_unobserved", 2):
        for exceptions in _atoms(control, "number_exceptions", 1):
            explained = _preferred(control, (events, exceptions), kept=False)
            if explained is not None:
                return explained
    return None


def _atoms(control: clingo.Control, predicate: str, arity: int) -> list[int]:
    """The solver literals of predicate(N,...) in the order of N."""
    atoms = control.symbolic_atoms.by_signature(predicate, arity)
    return [atom.literal for atom in sorted(atoms, key=lambda atom: atom.symbol.arguments[0])]


def _preferred(
    control: clingo.Control, assumptions: tuple[int, ...], kept: bool
) -> Explained | None:
    with preferring(control, assumptions) as model:
        return None if model is None else explained_by(model.symbols(shown=True), kept)


def explained_by(model: Sequence[Symbol], kept: bool, proved: bool = True) -> Explained:
    """What an answer set of the theory of diagnosis says, and whether nothing smaller does."""
    diagnosis = Diagnosis(
        unobserved=_events(model, "unobserved"),
        distrusted=_events(model, "distrusted"),
        exceptions=tuple(sorted(str(name) for (name,) in select(model, "exception", 1))),
        initial=tuple(
            sorted(
                str(fluent) if str(truth) == "true" else f"-{fluent}"
                for fluent, truth in select(model, "initial", 2)
            )
        ),
        proved=proved,
    )
    indices = {name.number: index.number for name, index in select(model, "index", 2)}
    return Explained(diagnosis, kept, indices)


def _events(model: Sequence[Symbol], predicate: str) -> tuple[Event, ...]:
    events = sorted((step.number, str(action)) for action, step in select(model, predicate, 2))
    return tuple(Event(step=step, action=action) for step, action in events)
