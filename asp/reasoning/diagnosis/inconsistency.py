"""Why a history is inconsistent: observations that cannot all hold."""

from collections.abc import Callable, Iterable
from typing import Any

from clingo import Symbol

from asp.language import Literal
from asp.reasoning.diagnosis.history import History
from asp.reasoning.knowledge import Knowledge, goal_facts
from asp.solving import core, fact, ground, literal_of, optimal_model, select, theory


def conflict(program: str, facts: Iterable[Symbol], step: int) -> tuple[str, ...] | None:
    """A smallest set of a history's observations that no events explain; None: there is none.

    `program` is a domain's translation; `facts` are the history up to `step`, the goal, and what an
    initial state must have. None of the observations can be left out; late ones are preferred. An
    element is `obs(LITERAL) at STEP`, or `hpd(ACTION) at STEP` for the result of an attempt, with
    `-` before an action that did not take effect. Raises LimitError.
    """
    found = _core(program, facts, step, _place)
    return None if found is None else tuple(map(_text, found))


def distrust_tests(knowledge: Knowledge, goal: Iterable[Literal], history: History) -> bool:
    """Takes the fewest doubtful observations for wrong that have to be, whatever events occurred.

    False where the history is inconsistent all the same. Raises LimitError.
    """
    if not history.has_doubts:
        return False
    told = [symbol for symbol in history.facts() if not symbol.match("misread", 2)]
    texts = [knowledge.program, theory("conflict"), theory("misreadings")]
    facts = [*knowledge.start, *goal_facts(goal), *told]
    model, _ = optimal_model(ground(texts, {"n": history.step}, facts))
    wrong = () if model is None else select(model, "wrong", 2)
    if not wrong:
        return False
    history.distrust((time.number, literal_of(fluent)) for fluent, time in wrong)
    return True


def never_together(program: str, literals: Iterable[Literal]) -> tuple[str, ...] | None:
    """A smallest part of some literals that no state has; None: there is a state that has them all.

    `program` is a domain's translation. None of the literals named can be left out. Raises
    LimitError.
    """
    wanted = {
        fact("obs", literal.atom, "true" if literal.is_positive else "false", 0): literal
        for literal in literals
    }
    part = _core(program, [*wanted, fact("current_step", 0)], 0, list(wanted).index)
    return None if part is None else tuple(wanted[statement] for statement in part)


def cannot_hold(observations: tuple[str, ...]) -> str:
    """One sentence about a conflict."""
    if not observations:
        return "whatever is observed, the domain has no initial state"
    if len(observations) == 1:
        return f"{observations[0]} cannot hold"
    together = "both" if len(observations) == 2 else "all"
    return f"{', '.join(observations[:-1])} and {observations[-1]} cannot {together} hold"


def _core(
    program: str, facts: Iterable[Symbol], step: int, place: Callable[[Symbol], Any]
) -> list[Symbol] | None:
    """A smallest part of what is stated that cannot be; those of later places first."""
    control = ground([program, theory("conflict")], {"n": step}, facts)
    atoms = control.symbolic_atoms.by_signature("stated", 1)
    statements = {atom.literal: atom.symbol.arguments[0] for atom in atoms}
    found = core(control, [], sorted(statements, key=lambda literal: place(statements[literal])))
    return None if found is None else [statements[literal] for literal in found]


def _place(statement: Symbol) -> tuple[int, str]:
    return statement.arguments[2].number, str(statement)


def _text(statement: Symbol) -> str:
    what, truth, step = statement.arguments
    sign = "" if str(truth) == "true" else "-"
    return f"{statement.name}({sign}{what}) at {step}"
