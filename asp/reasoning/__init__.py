"""Plans, explanations and inferences, from descriptions and histories."""

from asp.reasoning.domain import Domain as Domain
from asp.reasoning.domain import Step as Step
from asp.reasoning.domain import load as load
from asp.reasoning.knowledge import Goal as Goal
from asp.reasoning.knowledge import Knowledge as Knowledge
from asp.reasoning.knowledge import goal_facts as goal_facts
from asp.reasoning.knowledge import knowledge as knowledge
from asp.reasoning.knowledge import satisfied as satisfied
from asp.reasoning.relevance import Relevance as Relevance
from asp.reasoning.relevance import interchangeable as interchangeable
from asp.reasoning.successors import Transitions as Transitions
from asp.reasoning.successors import in_order as in_order
from asp.reasoning.successors import place_of as place_of
