"""The sessions of the solver in each domain, made once in a process."""

from dataclasses import dataclass

from asp.reasoning.diagnosis import DiagnosisSessions
from asp.reasoning.knowledge import Knowledge
from asp.reasoning.planning import IncrementalPlanner, Reachability
from asp.reasoning.successors import Transitions
from asp.solving import Recent


@dataclass(frozen=True)
class Sessions:
    """The sessions of one domain; they outlive goals and trials."""

    diagnosis: DiagnosisSessions
    plans: IncrementalPlanner
    reach: Reachability

    @property
    def transitions(self) -> Transitions:
        """The transition diagram."""
        return self.diagnosis.transitions


MOST_DOMAINS = 16
"""Of how many domains sessions are kept: those that were used last."""

_SESSIONS: Recent[str, Sessions] = Recent(MOST_DOMAINS)


def sessions_of(knowledge: Knowledge) -> Sessions:
    """The sessions of a domain, made when they are first asked for.

    A robot whose domain follows from its goal has as many domains as goals.
    """

    def made() -> Sessions:
        description = knowledge.description
        plans = IncrementalPlanner(description.source, f"{description.name}.al")
        diagnosis = DiagnosisSessions(knowledge)
        reach = Reachability(description, diagnosis.transitions, plans.reachable)
        return Sessions(diagnosis, plans, reach)

    return _SESSIONS.get(knowledge.program, made)
