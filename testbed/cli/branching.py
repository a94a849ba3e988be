"""Warnings of a description in which an action has several outcomes, or none."""

from asp.language import Description
from asp.reasoning.determinism import Branching, branchings
from asp.reasoning.qualifications import Qualification, qualifications
from asp.solving import LimitError
from testbed.text import warn


def warn_of_branching(description: Description, program: str, file: str) -> None:
    """Say on standard error where an action has several outcomes, and where doing nothing has.

    `program` is the translation of the description. One line per witness, with the state, the
    action and the outcomes; or that the search of all states came to no end.
    """
    try:
        found = branchings(description, program)
    except LimitError as limit:
        warn(f"{file}: warning: not known whether an action has several outcomes: {limit}")
        return
    for each in found:
        warn(f"{file}: warning: {_told(each, description)} (all states were searched)")


def warn_of_qualifications(description: Description, program: str, file: str) -> None:
    """Say on standard error which actions contradict constraints, though no law forbids them.

    `program` is the translation of the description. One line per action, whatever its arguments,
    with one condition; or that the search for all conditions came to no end.
    """
    found: dict[str, Qualification] = {}
    try:
        for each in qualifications(description, program):
            found.setdefault(each.action.name, each)
    except LimitError as limit:
        warn(f"{file}: warning: not known where all actions contradict constraints: {limit}")
    for one in found.values():
        body = ", ".join(one.body) or "any state"
        why = "its effects contradict a constraint, and no law says that it is impossible"
        warn(f"{file}: warning: {one.action} cannot be executed where {body}: {why}")


def _told(found: Branching, description: Description) -> str:
    def literals(state: frozenset[str]) -> str:
        return ", ".join(f for f in description.fluents if f in state) or "nothing"

    outcomes = " | ".join(map(literals, found.outcomes))
    if found.action is None:
        return f"doing nothing changes the state {literals(found.state)} to {outcomes}"
    return f"{found.action} has several outcomes in the state {literals(found.state)}: {outcomes}"
