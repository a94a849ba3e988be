"""Decisions in other names of constants, field by field; literals by their parts."""

from __future__ import annotations

import re
from collections.abc import Mapping

from msgspec import structs

from asp.language import renamed
from testbed.protocol import Contradiction, Decision, Event, Explanation, Trace

Names = Mapping[str, str]

_ATOM = re.compile(r"\w+\([\w,]+\)")
"""An atom in a sentence; where else the word of a constant stands there, it is another word."""

_RESULT = re.compile(r"(?:hpd|impossible)\(")


def renamed_decision(decision: Decision, names: Names) -> Decision:
    """The decision in these names of constants; one without a new name keeps its own."""
    trace = renamed_trace(decision.trace, names)
    return structs.replace(decision, action=renamed(decision.action, names), trace=trace)


def renamed_trace(trace: Trace, names: Names) -> Trace:
    """The trace in these names; the fine resolution, which is not renamed, has none in it."""
    explanation = trace.explanation
    return structs.replace(
        trace,
        intention=renamed(trace.intention, names),
        plan=[renamed(action, names) for action in trace.plan],
        belief=[renamed(fluent, names) for fluent in trace.belief],
        explanation=None if explanation is None else _explanation(explanation, names),
        contradictions=[_contradiction(each, names) for each in trace.contradictions],
        alternatives=[_explanation(each, names) for each in trace.alternatives],
        reason=_ATOM.sub(lambda found: renamed(found[0], names), trace.reason),
    )


def renamed_event(event: Event, names: Names) -> Event:
    """The event with its action in these names."""
    return structs.replace(event, action=renamed(event.action, names))


def _explanation(explanation: Explanation, names: Names) -> Explanation:
    return structs.replace(
        explanation,
        unobserved=[renamed_event(event, names) for event in explanation.unobserved],
        exceptions=[renamed(literal, names) for literal in explanation.exceptions],
        distrusted=[renamed_event(event, names) for event in explanation.distrusted],
    )


def _contradiction(contradiction: Contradiction, names: Names) -> Contradiction:
    return structs.replace(
        contradiction,
        observed=_side(contradiction.observed, names),
        believed=_side(contradiction.believed, names),
    )


def _side(side: str, names: Names) -> str:
    """A literal, or a statement about an action around one."""
    result = _RESULT.match(side)
    if result is None:
        return renamed(side, names)
    return f"{result[0]}{renamed(side[result.end() : -1], names)})"
