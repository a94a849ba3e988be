"""A decision as one program that clingo alone solves, for people who read and check it."""

from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass
from itertools import groupby
from textwrap import fill
from typing import Protocol, runtime_checkable

from clingo import Symbol

from agents.intentional.activities import History
from agents.intentional.reasoners import BEYOND_LIMIT, Program, ReferenceReasoner
from agents.shared import Intention
from asp.reasoning import Knowledge
from asp.reasoning.diagnosis import GOAL, Diagnosis, Explanation
from asp.reasoning.knowledge import Goal
from testbed.protocol import FINISH

_ORDER, _HISTORY = "The order of declaration", "The history, step by step"
_ACTIVITIES, _EXPLANATION = "The activities so far", "The adopted explanation"
HEADING = {
    "goal": "The goal",
    **dict.fromkeys(("obs", "attempt", "hpd", "doubtful", "misread", "failing"), _HISTORY),
    "current_step": _HISTORY,
    **dict.fromkeys(("activity_goal", "activity_length", "activity_component"), _ACTIVITIES),
    **dict.fromkeys(("explanation", "explained", "explained_distrusted"), _EXPLANATION),
    **dict.fromkeys(("explained_exception", "explained_initial"), _EXPLANATION),
    "beyond_limit": "No plan within the limit achieves the goal",
}
"""What stands above the facts of a predicate, of others `_ORDER`."""
_FIRST_PLAN = """\
% ==== Of several shortest plans the first in the order of declaration ====

#minimize { R@n-I,A : occurs(A,I), rank(A,R), paa(A), current_step(I1), I1 < I }.

% Before that, as in (b): of several states the first in the order of the fluents, true before
% false, and the one in which more of the activity is done.
#defined fluent_rank/2.
fluents(N) :- N = #count { F : fluent_rank(F,R) }.
#maximize { 1@n+2+N-R,F : holds(F,I), fluent_rank(F,R), fluents(N), current_step(I) }.
#maximize { K@n+1,AN : holds(current_action_index(AN,K),I), current_step(I), K > 0 }.

% Before that, as in (a): no activity is futile that need not be.
#minimize { 1@n+5+N,AN : futile_activity(AN,I), fluents(N) }.
#maximize { 1@n+4+N : goes_on, fluents(N); 1@n+3+N : finishes, fluents(N) }.
"""


@dataclass(frozen=True)
class Decided:
    """An intention, and what it was derived from: the history as it was before the attempt."""

    knowledge: Knowledge
    goal: Goal
    history: History
    diagnosis: Diagnosis
    intention: Intention


Watcher = Callable[[Decided], None]


@runtime_checkable
class Watched(Protocol):
    """A robot whose decisions can be had as programs: it tells each before it is attempted."""

    watcher: Watcher | None


def program_of(decided: Decided) -> str:
    """Phase two of the reference, with the horizon at which it comes to this intention."""
    program = _phase_two(decided)
    constants = "\n".join(f"#const {n} = {k}. [override]" for n, k in program.constants.items())
    sections = {
        "Constants: the horizon, names of activities, the length of plans": constants,
        **{_title(name): text for name, text in program.texts.items()},
        **dict(_given(program.facts)),
    }
    told = (f"% ==== {title} ====\n\n{text.strip()}\n" for title, text in sections.items())
    return "\n".join([_header(decided), *told, _FIRST_PLAN])


def _phase_two(decided: Decided) -> Program:
    intention, history, diagnosis = decided.intention, decided.history, decided.diagnosis
    left = history.left(diagnosis.indices)
    gives_up = intention.action == FINISH and GOAL not in intention.believed
    reference = ReferenceReasoner(decided.knowledge, decided.goal, len(intention.plan))
    length = max(1, len(left), len(intention.plan))
    return reference.phase_two(history, diagnosis, length, BEYOND_LIMIT if gives_up else ())


def _header(decided: Decided) -> str:
    step, explanation = decided.history.step, decided.diagnosis.explanation
    lines = [
        "Run `clingo FILE`. Its last answer set has the intention:",
        f"    intended_action({decided.intention.action},{step})",
        f"The goal: {', '.join(decided.goal)}.",
        f"The adopted explanation: {', '.join(_assumed(explanation)) or 'nothing unobserved'}.",
        "The constant n is the horizon: the end of the plan.",
    ]
    return "".join(f"% {line}\n" for line in lines)


def _assumed(explanation: Explanation) -> Iterator[str]:
    yield from (f"{event} at step {step}" for step, event in explanation.unobserved)
    yield from (f"not {action} at step {step}" for step, action in explanation.distrusted)
    yield from (f"an exception to {default}" for default in explanation.exceptions)
    yield from (f"{literal} at step 0" for literal in explanation.initial)


def _title(name: str) -> str:
    return name if name == "description" else f"asp/theories/{name}.lp"


def _given(facts: Sequence[Symbol]) -> Iterator[tuple[str, str]]:
    """The facts under their headings; those of the history step by step."""
    for heading, own in groupby(facts, lambda each: HEADING.get(each.name, _ORDER)):
        if heading != _HISTORY:
            yield heading, _laid_out(own)
            continue
        steps = groupby(own, lambda each: each.arguments[-1])
        told = (f"% step {step}\n{_laid_out(said)}" for step, said in steps)
        yield heading, "\n".join(told)


def _laid_out(facts: Iterable[Symbol]) -> str:
    """One predicate after the other, with as many facts to a line as there is room for."""
    same = (" ".join(f"{each}." for each in own) for _, own in groupby(facts, lambda f: f.name))
    return "\n".join(
        fill(text, 100, break_long_words=False, break_on_hyphens=False) for text in same
    )
