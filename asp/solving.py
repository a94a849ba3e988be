"""Solving programs with clingo: grounding, one model, the smallest number that has one."""

from __future__ import annotations

import time
from collections.abc import Iterable, Mapping, Sequence
from functools import cache
from importlib.resources import files

import clingo
from clingo import Symbol

Assumption = tuple[Symbol, bool]

_OPTIONS = ("--heuristic=Domain", "--warn=none")
_POLL_S = 0.2


class TimeLimitError(RuntimeError):
    """A solver call was interrupted at its deadline."""


@cache
def theory(name: str) -> str:
    """The text of `asp/theories/NAME.lp`."""
    return files("asp").joinpath("theories", f"{name}.lp").read_text(encoding="utf-8")


def symbol(text: str) -> Symbol:
    """The ground term of a text. Raises ValueError if it is not one.

    Every text from outside goes through here on its way into a program, so that it can never be
    more than a term.
    """
    try:
        return clingo.parse_term(text, logger=lambda _code, _text: None)
    except RuntimeError:
        raise ValueError(f"{text!r} is not a ground term") from None


def fact(predicate: str, *arguments: Symbol | int | str) -> Symbol:
    """The atom of a predicate; integers become numbers, strings are read as ground terms."""
    return clingo.Function(predicate, [_argument(argument) for argument in arguments])


def _argument(value: Symbol | int | str) -> Symbol:
    if isinstance(value, Symbol):
        return value
    return clingo.Number(value) if isinstance(value, int) else symbol(value)


def ground(
    texts: Iterable[str], constants: Mapping[str, int], facts: Iterable[Symbol]
) -> clingo.Control:
    """A control with the ground program of the texts and facts.

    Solving is single-threaded and without randomness: the same texts, constants and facts in the
    same order give the same models. Where a program has `#heuristic` directives, its first model
    is the preferred one.
    """
    arguments = [part for name, value in constants.items() for part in ("-c", f"{name}={value}")]
    control = clingo.Control([*arguments, *_OPTIONS])
    for text in texts:
        control.add("base", [], text)
    control.add("base", [], "\n".join(f"{atom}." for atom in facts))
    control.ground([("base", [])])
    return control


def first_model(
    control: clingo.Control,
    assumptions: Sequence[Assumption] = (),
    deadline: float | None = None,
) -> tuple[Symbol, ...] | None:
    """The shown symbols of the first answer set, or None if there is none.

    `deadline` is a time of `time.monotonic()`. Raises TimeLimitError there; the control stays
    usable. The wait is polled, so that an interrupt from the keyboard reaches Python.
    """
    if any(not _is_known(control, atom) for atom, truth in assumptions if truth):
        return None
    with control.solve(assumptions=assumptions, yield_=True, async_=True) as handle:
        handle.resume()
        while not handle.wait(_POLL_S):
            if deadline is not None and time.monotonic() > deadline:
                handle.cancel()
                raise TimeLimitError("the time limit for one decision ran out")
        model = handle.model()
        return None if model is None else tuple(model.symbols(shown=True))


def _is_known(control: clingo.Control, atom: Symbol) -> bool:
    """Assuming the truth of an atom that no rule derives has no answer set."""
    return control.symbolic_atoms[atom] is not None


def select(model: Iterable[Symbol], predicate: str, arity: int) -> list[list[Symbol]]:
    """The argument lists of a predicate's atoms in a model, sorted."""
    return sorted(s.arguments for s in model if s.match(predicate, arity))
