"""Transition diagrams as clingo finds them in a translated program."""

from collections.abc import Iterable, Iterator

import clingo

State = frozenset[str]
"""The atoms that are true."""


def warnings_of(program: str) -> list[str]:
    """What clingo says while it reads and grounds the program; nothing is switched off."""
    messages: list[str] = []
    control = clingo.Control(logger=lambda _code, message: messages.append(message))
    control.add("base", [], program)
    control.ground([("base", [])])
    return messages


def states(program: str) -> frozenset[State]:
    """Every state: the answer sets at step 0."""
    return frozenset(_last(program, 0, ()))


def after(program: str, state: Iterable[str], *steps: Iterable[str]) -> frozenset[State]:
    """The states that may follow a state when at each step these actions occur together.

    The state is given by its true inertial atoms; every other inertial fluent is false.
    """
    given = [f"holds({atom},0)." for atom in state]
    given += [f":- holds(F,0), inertial(F){''.join(f', F != {atom}' for atom in state)}."]
    given += [f"occurs({action},{i})." for i, actions in enumerate(steps) for action in actions]
    return frozenset(_last(program, len(steps), given))


def _last(program: str, step: int, given: Iterable[str]) -> Iterator[State]:
    control = clingo.Control(["0", "-c", f"n={step}", "--warn=none"])
    control.add("base", [], program)
    control.add("base", [], f"{' '.join(given)} #show. #show F : holds(F,{step}).")
    control.ground([("base", [])])
    with control.solve(yield_=True) as handle:
        for model in handle:
            yield frozenset(str(atom) for atom in model.symbols(shown=True))
