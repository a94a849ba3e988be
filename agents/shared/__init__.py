"""Code that robots share: the turn of a step, reasoning, and its narration."""

from agents.shared.narration import Narration as Narration
from agents.shared.narration import Step as Step
from agents.shared.narration import listed as listed
from agents.shared.narration import retold as retold
from agents.shared.outlook import Conformant as Conformant
from agents.shared.outlook import Course as Course
from agents.shared.outlook import Optimistic as Optimistic
from agents.shared.outlook import Outlook as Outlook
from agents.shared.reasoning import Intention as Intention
from agents.shared.reasoning import Reasoner as Reasoner
from agents.shared.reasoning import limits_of as limits_of
from agents.shared.reasoning import outlook_of as outlook_of
from agents.shared.reasoning import sessions_of as sessions_of
from agents.shared.reasons import Reasons as Reasons
from agents.shared.robot import MakeReasoner as MakeReasoner
from agents.shared.robot import ReasoningRobot as ReasoningRobot
from agents.shared.thought import Thought as Thought
