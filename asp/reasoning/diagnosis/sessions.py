"""The sessions of the solver that diagnosis needs, made once for a domain."""

from asp.reasoning.diagnosis.belief import BeliefTracker
from asp.reasoning.diagnosis.long_histories.arcs import Arcs
from asp.reasoning.diagnosis.smallest_explanations import SmallestExplanations
from asp.reasoning.knowledge import Goal, Knowledge
from asp.reasoning.successors import Transitions


class DiagnosisSessions:
    """The sessions of the solver that diagnosis in one domain needs; they outlive histories."""

    def __init__(self, knowledge: Knowledge) -> None:
        self.knowledge = knowledge
        fluents, deterministic = knowledge.description.fluents, knowledge.deterministic
        self.transitions = Transitions(knowledge.program, fluents, deterministic)
        self.explanations = SmallestExplanations(knowledge)
        self.arcs = Arcs(knowledge)

    def tracker(self, goal: Goal, since: int = 0) -> BeliefTracker:
        """A tracker of beliefs about a goal; `since` is the first step with events."""
        return BeliefTracker(self.knowledge, self.transitions, goal, since)
