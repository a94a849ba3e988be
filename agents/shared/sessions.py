"""The kept controls of each domain, made once in a process."""

from __future__ import annotations

from dataclasses import dataclass

from agents.shared.knowledge import Knowledge
from asp.reasoning.diagnosis import Explanations, Windows
from asp.reasoning.planning import IncrementalPlanner, Reachability
from asp.reasoning.successors import Transitions
from asp.solving import Recent


@dataclass(frozen=True)
class Tools:
    """The kept controls of one domain; they outlive goals and trials."""

    transitions: Transitions
    explanations: Explanations
    windows: Windows
    plans: IncrementalPlanner
    reach: Reachability


MOST_DOMAINS = 16
"""Of how many domains controls are kept: those that were used last."""

_TOOLS: Recent[str, Tools] = Recent(MOST_DOMAINS)


def tools_of(knowledge: Knowledge) -> Tools:
    """The kept controls of a domain, made when they are first asked for.

    A robot whose domain follows from its goal has as many domains as goals.
    """
    return _TOOLS.get(knowledge.program, lambda: _made(knowledge))


def _made(knowledge: Knowledge) -> Tools:
    description, program, ranks = knowledge.description, knowledge.program, knowledge.ranks
    fluents = description.fluents
    plans = IncrementalPlanner(description.source, f"{description.name}.al")
    return Tools(
        Transitions(program, fluents, ranks),
        Explanations(
            program,
            fluents,
            description.exogenous_actions,
            [default.name for default in description.defaults],
            (*ranks, *knowledge.start),
        ),
        Windows(program, fluents, description.inertial, description.exogenous_actions, ranks),
        plans,
        Reachability(description, program, plans),
    )
