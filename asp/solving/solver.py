"""Solving programs with clingo: grounding, one model, many, a core; all within a budget."""

import time
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from functools import cache, lru_cache
from importlib.resources import files
from typing import Any, TypeAlias

import clingo
from clingo import Symbol

from asp.language import Literal
from asp.solving.budget import OUT_OF_BUDGET, BudgetError, count_rules, current
from asp.solving.signals import Deliver, undisturbed

Assumptions: TypeAlias = Sequence[tuple[Symbol, bool]] | Sequence[int]
"""Atoms with their truth, or literals of the solver."""

# A call of the solver that blocks answers in microseconds where one in the background takes a
# millisecond, but it keeps signals from Python: it may only take some milliseconds.
_BURST_CONFLICTS = 2000
# Nothing that was learned is kept from one call to the next: how many conflicts a call takes, and
# whether a budget suffices, hardly depends on what a session was asked before.
_OPTIONS = (
    "--heuristic=Domain",
    "--warn=none",
    "--forget-on-step=varScores,signs,lemmaScores,lemmas",
    f"--solve-limit={_BURST_CONFLICTS}",
)
_POLL_S = 0.2


@cache
def theory(name: str) -> str:
    """The text of `asp/theories/NAME.lp`."""
    return files("asp").joinpath("theories", f"{name}.lp").read_text(encoding="utf-8")


@lru_cache(maxsize=100_000)
def literal_of(symbol: Symbol) -> Literal:
    """The ground fluent or action that a term stands for."""
    return Literal.of(symbol.name, map(str, symbol.arguments), symbol.positive)


def fact(predicate: str, *arguments: Symbol | int | str) -> Symbol:
    """The atom of a predicate; integers become numbers, strings are read as ground terms.

    Every text from outside goes through here on its way into a program, so that it can never be
    more than a term. Raises ValueError if it is not one.
    """
    return clingo.Function(predicate, [_term(argument) for argument in arguments])


def _term(value: Symbol | int | str) -> Symbol:
    if isinstance(value, Symbol):
        return value
    if isinstance(value, int):
        return clingo.Number(value)
    try:
        return clingo.parse_term(value, logger=lambda _code, _text: None)
    except RuntimeError:
        raise ValueError(f"{value!r} is not a ground term") from None


def ground(
    texts: Iterable[str],
    constants: Mapping[str, int],
    facts: Iterable[Symbol | str],
    parts: Iterable[str] = (),
) -> clingo.Control:
    """A control with the ground program of the texts and facts, and of these parts of the texts.

    Solving is single-threaded and without randomness: the same texts, constants and facts in the
    same order give the same models. Where a program has `#heuristic` directives, its first model
    is the preferred one. Raises LimitError where it is too large for the decision under way.
    """
    texts = tuple(texts)
    arguments = [part for name, value in constants.items() for part in ("-c", f"{name}={value}")]
    control = clingo.Control([*arguments, *_OPTIONS])
    parts = ("base", *parts)
    count_rules(control, (*texts, *parts), constants)
    for text in texts:
        control.add("base", [], text)
    control.add("base", [], "\n".join(f"{atom}." for atom in facts))
    control.ground([(part, []) for part in parts])
    return control


@contextmanager
def solving(
    control: clingo.Control, assumptions: Assumptions = ()
) -> Iterator[clingo.Model | None]:
    """The first model of a control made by `ground`, to be read while this is open; None: none.

    Raises LimitError. An interrupt from the keyboard reaches Python, whatever the solver does.
    """
    current().check_time()
    with undisturbed() as deliver:
        with control.solve(assumptions=assumptions, yield_=True) as handle:
            model = handle.model()
            if model is not None or not handle.get().unknown:
                yield model
                return
        with _in_background(control, assumptions, deliver) as handle:
            model = handle.model()
            if model is None and handle.get().unknown:
                raise BudgetError(OUT_OF_BUDGET)
            yield model


def is_satisfiable(control: clingo.Control, assumptions: Assumptions = ()) -> bool:
    """Whether there is an answer set. Raises LimitError."""
    with solving(control, assumptions) as model:
        return model is not None


def answer_sets(
    control: clingo.Control, assumptions: Assumptions = (), most: int | None = None
) -> tuple[list[tuple[Symbol, ...]], bool]:
    """The shown symbols of the answer sets, each once, and whether there are more than `most`.

    Raises LimitError.
    """
    current().check_time()
    settings: Any = control.configuration.solve
    before = settings.models, settings.project
    with undisturbed() as deliver:
        settings.models, settings.project = "0", "show"
        try:
            with control.solve(assumptions=assumptions, yield_=True) as handle:
                found, more = _collect(handle, most, lambda: None)
                if more or handle.get().exhausted:
                    return found, more
            with _in_background(control, assumptions, deliver) as handle:
                found, more = _collect(handle, most, lambda: _wait(handle, deliver))
                if not (more or handle.get().exhausted):
                    raise BudgetError(OUT_OF_BUDGET)
                return found, more
        finally:
            settings.models, settings.project = before


def _collect(
    handle: clingo.SolveHandle, most: int | None, wait: Callable[[], None]
) -> tuple[list[tuple[Symbol, ...]], bool]:
    found: list[tuple[Symbol, ...]] = []
    while (model := handle.model()) is not None:
        if len(found) == most:
            return found, True
        found.append(tuple(model.symbols(shown=True)))
        handle.resume()
        wait()
    return found, False


@contextmanager
def _in_background(
    control: clingo.Control, assumptions: Assumptions, deliver: Deliver
) -> Iterator[clingo.SolveHandle]:
    """A search with what is left of the decision's conflicts, inside `undisturbed`."""
    settings: Any = control.configuration.solve
    budget = current()
    budget.take_conflicts(_BURST_CONFLICTS)
    budget.check_conflicts()
    left = budget.conflicts
    settings.solve_limit = "umax" if left is None else str(left)  # umax: no limit
    try:
        with control.solve(assumptions=assumptions, yield_=True, async_=True) as handle:
            _wait(handle, deliver)
            yield handle
    finally:
        settings.solve_limit = str(_BURST_CONFLICTS)
        budget.take_conflicts(int(control.statistics["solving"]["solvers"]["conflicts"]))


def _wait(handle: clingo.SolveHandle, deliver: Deliver) -> None:
    """Polls, so that signals reach Python meanwhile."""
    deadline = current().deadline
    while True:
        left = _POLL_S if deadline is None else min(_POLL_S, deadline - time.monotonic())
        if handle.wait(max(0.0, left)):
            return
        deliver()
        if left <= 0.0:
            handle.cancel()
            raise current().out_of_time()


def first_model(
    control: clingo.Control, assumptions: Sequence[tuple[Symbol, bool]] = ()
) -> tuple[Symbol, ...] | None:
    """The shown symbols of the first answer set, or None if there is none.

    Raises LimitError.
    """
    if any(truth and control.symbolic_atoms[atom] is None for atom, truth in assumptions):
        return None  # no rule derives what is assumed to be true
    with solving(control, assumptions) as model:
        return None if model is None else tuple(model.symbols(shown=True))


def optimal_model(control: clingo.Control) -> tuple[tuple[Symbol, ...] | None, bool]:
    """The shown symbols of the first answer set that is best by `#minimize`; None: there is none.

    With it, whether that is proved. The program is solved in one call, in which clasp betters one
    answer set after another; where the budget is used up the best one found is given. Raises
    LimitError where none was found.
    """
    current().check_time()
    with undisturbed() as deliver, _in_background(control, (), deliver) as handle:
        found, _ = _collect(handle, None, lambda: _wait(handle, deliver))
        proved = handle.get().exhausted
        if not (found or proved):
            raise BudgetError(OUT_OF_BUDGET)
    return (found[-1] if found else None), proved


def select(model: Iterable[Symbol], predicate: str, arity: int) -> list[list[Symbol]]:
    """The argument lists of a predicate's atoms in a model, sorted."""
    return sorted(s.arguments for s in model if s.match(predicate, arity))
