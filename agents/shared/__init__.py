"""What robots have in common: the turn of a step, reasoning, what is told of it."""

from agents.shared.narration import Narration, Step, listed, retold
from agents.shared.reasoning import MOST_DOMAINS, Intention, Reasoner, Sessions, sessions_of
from agents.shared.reasons import Reasons
from agents.shared.robot import MakeReasoner, ReasoningRobot, Thought, limits_of

__all__ = [
    "MOST_DOMAINS",
    "Intention",
    "MakeReasoner",
    "Narration",
    "Reasoner",
    "ReasoningRobot",
    "Reasons",
    "Sessions",
    "Step",
    "Thought",
    "limits_of",
    "listed",
    "retold",
    "sessions_of",
]
