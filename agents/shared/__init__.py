"""What robots have in common: the turn of a step, reasoning, what is told of it."""

from agents.shared.narration import Narration, Step, listed, retold
from agents.shared.reasoning import Intention, Reasoner, limits_of, sessions_of
from agents.shared.reasons import Reasons
from agents.shared.robot import MakeReasoner, ReasoningRobot, Thought

__all__ = [
    "Intention",
    "MakeReasoner",
    "Narration",
    "Reasoner",
    "ReasoningRobot",
    "Reasons",
    "Step",
    "Thought",
    "limits_of",
    "listed",
    "retold",
    "sessions_of",
]
