"""Phase one from scratch: the smallest explanation of a history (D 2.4, (25)-(27), P 3.1.2)."""

from collections.abc import Iterable, Iterator, Sequence
from math import inf
from typing import ClassVar, Generic, Self

import clingo
from clingo import Symbol

from asp.reasoning.diagnosis.explanations import (
    Diagnosis,
    Explanation,
    H_contra,
    InconsistentHistoryError,
    explanation_of,
)
from asp.reasoning.diagnosis.inconsistency import cannot_hold, conflict
from asp.reasoning.knowledge import Goal, Knowledge, goal_facts
from asp.solving import (
    BudgetError,
    Limits,
    current,
    deciding,
    fact,
    ground,
    preferring,
    select,
    solving,
    theory,
    up_to,
)

SEARCH, BETTERING = 0.5, 0.75
"""The parts of a decision's conflicts by which a diagnosis has looked for the smallest explanation,
and then for the best it can find; what is left is for planning."""

_KEEP, _KEEP_INITIAL = clingo.Function("keep"), clingo.Function("keep_initial")
_FIRST_TRY, _ROOM, _FIRST_END = 4, 16, 4
_EXPLAINING = ("defaults", "order", "diagnosis")


class ReferenceDiagnoser(Generic[H_contra]):
    """Explains histories of one domain, for one goal; each call solves its program from scratch."""

    theories: ClassVar[Sequence[str]] = ("history",)
    """The theories beside those of explanations."""

    def __init__(self, knowledge: Knowledge, goal: Goal) -> None:
        self._base = (knowledge.program, *map(theory, self.theories))
        self._given = (*knowledge.ranks, *knowledge.start, *goal_facts(goal))

    def diagnose(self, history: H_contra, adopted: Explanation, /) -> Diagnosis:
        """The adopted explanation if it is still as small as any, else the first smallest one.

        Of the adopted one its events and exceptions are kept, what it says of step 0 if that can
        be. Where the budget of the decision does not suffice for the smallest one it is the best
        one found, which is not `proved`. Raises InconsistentHistoryError and LimitError.
        """
        return self._diagnose(history, adopted, keeps=True)

    def copy(self) -> Self:
        """Itself: nothing is kept of a history."""
        return self

    def _facts(self, history: H_contra) -> Iterator[Symbol]:
        """What is given of a history."""
        yield from self._given
        yield from history.facts()

    def _constants(self, _history: H_contra, horizon: int, _longest: int = 0, /) -> dict[str, int]:
        """The constants of a program; `_longest` is the length of the longest plan it can have."""
        return {"n": horizon}

    def _diagnose(self, history: H_contra, adopted: Explanation, keeps: bool) -> Diagnosis:
        step, size = history.step, adopted.size
        given = [*self._facts(history), fact("explaining", step), *adopted.facts("adopted")]
        programs = [*self._base, *map(theory, _EXPLAINING)]
        constants = self._constants(history, step)

        def counting(most: int) -> clingo.Control:
            return ground(programs, {**constants, "max_unobserved": most}, given)

        def smallest(most: int) -> Diagnosis | None:
            control = counting(most)
            found, kept = _smallest(control), _kept(control) if keeps else None
            is_smallest = found and kept and kept.explanation.price <= found.explanation.price
            return kept if is_smallest else found

        try:
            with up_to(SEARCH):
                current().check_conflicts()
                if history.has_doubts:  # where some are wrong no number of events need be tried
                    _check(programs[0], given, step)
                limits = event_limits(programs[0], given, step, size)
                return next(filter(None, map(smallest, limits)))
        except BudgetError:
            pass
        room = _room_for_events(given, step, size + _ROOM)
        best = (_best(counting(most), adopted, step) for most in room)
        return next(filter(None, best))


def event_limits(program: str, facts: Sequence[Symbol], step: int, adopted: int) -> Iterator[int]:
    """Ever larger numbers of unobserved events to try on a history up to `step`.

    `program` is the domain; an explanation of `adopted` events is within the first limit.

    Raises:
        InconsistentHistoryError: instead of the next number, if no number suffices.
    """
    for most in _room_for_events(facts, step, max(_FIRST_TRY, adopted)):
        yield most
        _check(program, facts, step)


def diagnosis_of(model: Iterable[Symbol], proved: bool = True) -> Diagnosis:
    """What an answer set of the theory of diagnosis says, and whether nothing smaller does."""
    indices = {name.number: index.number for name, index in select(model, "index", 2)}
    return Diagnosis(explanation_of(model, proved), indices)


def _room_for_events(facts: Iterable[Symbol], step: int, first: int) -> Iterator[int]:
    """Ever larger numbers of events, up to all that can have occurred before the step.

    Raises InconsistentHistoryError instead of one more.
    """
    possible = step * sum(symbol.match("rank", 2) for symbol in facts)
    while first < possible:
        yield first
        first *= 4
    yield possible
    raise InconsistentHistoryError(f"nothing explains the observations up to step {step}")


def _check(program: str, facts: Sequence[Symbol], step: int) -> None:
    """Raises InconsistentHistoryError if no number of events explains a history."""
    found = conflict(program, facts, step)
    if found is not None:
        raise InconsistentHistoryError(f"inconsistent history: {cannot_hold(found)}")


def _kept(control: clingo.Control) -> Diagnosis | None:
    """The adopted explanation, with what was assumed of the initial state if that is possible."""
    for initial in (True, False):
        control.assign_external(_KEEP, True)
        control.assign_external(_KEEP_INITIAL, initial)
        found = _preferred(control)
        control.assign_external(_KEEP, False)
        control.assign_external(_KEEP_INITIAL, False)
        if found is not None:
            return found
    return None


def _smallest(control: clingo.Control) -> Diagnosis | None:
    """As few unobserved events as possible, and then as few exceptions to defaults."""
    for _, events in _numbered(control, "number_unobserved", 2):
        for _, exceptions in _numbered(control, "number_exceptions", 1):
            found = _preferred(control, (events, exceptions))
            if found is not None:
                return found
    return None


def _numbered(control: clingo.Control, predicate: str, arity: int) -> list[tuple[int, int]]:
    """Each N with the solver literal of predicate(N,...), in the order of N."""
    atoms = control.symbolic_atoms.by_signature(predicate, arity)
    return sorted((atom.symbol.arguments[0].number, atom.literal) for atom in atoms)


def _preferred(
    control: clingo.Control, assumptions: Sequence[int] = (), proved: bool = True
) -> Diagnosis | None:
    with preferring(control, assumptions) as model:
        return None if model is None else diagnosis_of(model.symbols(shown=True), proved)


def _best(control: clingo.Control, adopted: Explanation, step: int) -> Diagnosis | None:
    """The best explanation found where there is no time for a smallest one; None: there is none.

    What was adopted is kept of all but the last steps, first of nearly all and then of ever less:
    so the first explanation is found at once in most cases, and better ones follow. While
    conflicts are left, ever more of the history is explained anew; if all of it is and no
    explanation was found, the search goes on until there is one, or time runs out: raises
    LimitError.
    """
    best: Diagnosis | None = None
    ends = [_FIRST_END << doubled for doubled in range(step.bit_length())]
    windows = [*(window for window in ends if window < step), step]
    for number, window in enumerate(windows, start=1):
        kept = list(_keeping(control, adopted, step - window))
        try:
            with up_to(SEARCH + (BETTERING - SEARCH) * number / len(windows)):
                while better := _preferred(control, [*kept, *_below(control, best)], proved=False):
                    best = better
        except BudgetError:
            continue
        if best is None and window == step:
            return None
    return best or _any(control)


def _keeping(control: clingo.Control, adopted: Explanation, until: int) -> Iterator[int]:
    """Assumptions for the events and distrusted reports that were adopted, before a step."""
    kept = {"unobserved": adopted.unobserved, "distrusted": adopted.distrusted}
    for predicate, happenings in kept.items():
        for atom in control.symbolic_atoms.by_signature(predicate, 2):
            action, step = atom.symbol.arguments
            if step.number < until:
                yield atom.literal if (step.number, str(action)) in happenings else -atom.literal


def _below(control: clingo.Control, best: Diagnosis | None) -> list[int]:
    """Assumptions for fewer events and distrusted reports than the best one has."""
    size = inf if best is None else best.explanation.size
    every = _numbered(control, "number_unobserved", 2)
    return [-literal for number, literal in every if number >= size]


def _any(control: clingo.Control) -> Diagnosis | None:
    """An explanation of any size, by a heuristic that is good at finding one."""
    control.configuration.solver.heuristic = "vsids"  # type: ignore[union-attr]
    with deciding(Limits(current().limits.seconds)), solving(control) as model:
        return None if model is None else diagnosis_of(model.symbols(shown=True), proved=False)
