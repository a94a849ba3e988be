"""The last resort where no events explain a history: tests were wrong, as few as possible."""

from __future__ import annotations

from agents.shared.history import History
from agents.shared.knowledge import Knowledge, goal_facts
from asp.reasoning.diagnosis import misreadings


def distrust(knowledge: Knowledge, goal: tuple[str, ...], history: History) -> bool:
    """Takes doubtful observations for wrong (`misreadings.lp`); False: that does not help.

    Raises LimitError.
    """
    if not history.has_doubts:
        return False
    told = [symbol for symbol in history.facts() if not symbol.match("misread", 2)]
    facts = [*knowledge.start, *goal_facts(goal), *told]
    wrong = misreadings(knowledge.program, facts, history.step)
    if not wrong:
        return False
    history.distrust(wrong)
    return True
