"""Why a history is inconsistent: observations that cannot all hold."""

from __future__ import annotations

from collections.abc import Iterable

from clingo import Symbol

from asp.solving import core, ground, theory


def conflict(program: str, facts: Iterable[Symbol], step: int) -> tuple[str, ...] | None:
    """A smallest set of a history's observations that no events explain; None: there is none.

    `program` is a domain's translation; `facts` are the history up to `step`, the goal, and what an
    initial state must have. None of the observations can be left out; late ones are preferred. An
    element is `obs(LITERAL) at STEP`, or `hpd(ACTION) at STEP` for the result of an attempt, with
    `-` before an action that did not take effect. Raises TimeLimitError.
    """
    control = ground([program, theory("conflict")], {"n": step}, facts)
    atoms = control.symbolic_atoms.by_signature("stated", 1)
    statements = {atom.literal: atom.symbol.arguments[0] for atom in atoms}
    in_order = sorted(statements, key=lambda literal: _place(statements[literal]))
    found = core(control, [], in_order)
    return None if found is None else tuple(_text(statements[literal]) for literal in found)


def cannot_hold(observations: tuple[str, ...]) -> str:
    """One sentence about a conflict."""
    if not observations:
        return "whatever is observed, the domain has no initial state"
    if len(observations) == 1:
        return f"{observations[0]} cannot hold"
    together = "both" if len(observations) == 2 else "all"
    return f"{', '.join(observations[:-1])} and {observations[-1]} cannot {together} hold"


def _place(statement: Symbol) -> tuple[int, str]:
    return statement.arguments[2].number, str(statement)


def _text(statement: Symbol) -> str:
    what, truth, step = statement.arguments
    sign = "" if str(truth) == "true" else "-"
    return f"{statement.name}({sign}{what}) at {step}"
