"""The two phases of reasoning, and the sessions of the solver, made once for a domain."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Protocol

from agents.shared.outlook import Conformant, Optimistic, Outlook
from asp.language import Action, Fluent
from asp.reasoning import Knowledge, Transitions
from asp.reasoning.diagnosis import Diagnoser, Diagnosis, DiagnosisSessions, H_contra
from asp.reasoning.planning import IncrementalConformantPlanner, IncrementalPlanner, Reachability
from asp.solving import Limits, Recent
from testbed.protocol import Plans, Task


@dataclass(frozen=True)
class Intention:
    """What the agent intends at a step, the plan it would start with it, and what it believes.

    Where the goal holds, or the plan that led to it is over, `GOAL` is among what is `believed`.
    `under` is the diagnosis that it believes in, where this is chosen with the intention.
    """

    action: Action
    plan: tuple[Action, ...]
    believed: frozenset[Fluent]
    under: Diagnosis | None = None


class Reasoner(Diagnoser[H_contra], Protocol[H_contra]):
    """The two phases of reasoning about one goal, from scratch or incrementally."""

    def intend(self, history: H_contra, diagnosis: Diagnosis, /) -> Intention:
        """Phase two. Raises LimitError."""


@dataclass(frozen=True)
class Sessions:
    """The sessions of one domain; they outlive goals and trials."""

    transitions: Transitions
    diagnosis: DiagnosisSessions
    plans: IncrementalPlanner
    conformant: IncrementalConformantPlanner
    reach: Reachability


def limits_of(task: Task) -> Limits:
    """What a decision about a task may take."""
    return Limits(task.decision_s, task.conflicts, task.ground_rules, task.expansions)


MOST_DOMAINS = 16
"""Of how many domains sessions are kept: those that were used last."""

_SESSIONS: Recent[tuple[str, Sequence[Action]], Sessions] = Recent(MOST_DOMAINS)


def sessions_of(knowledge: Knowledge) -> Sessions:
    """The sessions of a domain, made when they are first asked for.

    A robot whose domain follows from its goal has as many domains as goals.
    """

    def made() -> Sessions:
        description = knowledge.description
        plans = IncrementalPlanner(description.source, f"{description.name}.al")
        diagnosis = DiagnosisSessions(knowledge)
        transitions, actions = diagnosis.transitions, description.agent_actions
        conformant = IncrementalConformantPlanner(actions, transitions, plans)
        reach = Reachability(description, transitions, plans)
        return Sessions(transitions, diagnosis, plans, conformant, reach)

    order = knowledge.description.exogenous_actions
    return _SESSIONS.get((knowledge.program, order), made)


def outlook_of(knowledge: Knowledge, plans: Plans) -> Outlook:
    """How plans of a domain are judged, by its sessions."""
    sessions = sessions_of(knowledge)
    if plans == "conformant" and not knowledge.deterministic:
        return Conformant(sessions.conformant)
    return Optimistic(sessions.plans)
