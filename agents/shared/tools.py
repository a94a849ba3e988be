"""The kept controls of each domain, made once in a process."""

from __future__ import annotations

from dataclasses import dataclass

from agents.shared.knowledge import Knowledge
from asp.kept.explanations import Explanations
from asp.kept.plans import Plans
from asp.kept.reach import Reach
from asp.kept.transitions import Transitions


@dataclass(frozen=True)
class Tools:
    """The kept controls of one domain; they outlive goals and trials."""

    transitions: Transitions
    explanations: Explanations
    plans: Plans
    reach: Reach


_TOOLS: dict[str, Tools] = {}


def tools_of(knowledge: Knowledge) -> Tools:
    """The kept controls of a domain, made when they are first asked for."""
    if knowledge.program not in _TOOLS:
        description, program, ranks = knowledge.description, knowledge.program, knowledge.ranks
        fluents = description.fluents
        _TOOLS[knowledge.program] = Tools(
            Transitions(program, fluents, ranks),
            Explanations(
                program,
                fluents,
                description.exogenous_actions,
                [default.name for default in description.defaults],
                (*ranks, *knowledge.start),
            ),
            Plans(description.source, f"{description.name}.al"),
            Reach(description, program),
        )
    return _TOOLS[knowledge.program]
