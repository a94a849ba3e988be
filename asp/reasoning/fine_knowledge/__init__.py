"""What a robot knows at the fine resolution, and what follows from it."""

from asp.reasoning.fine_knowledge.incremental import Quick
from asp.reasoning.fine_knowledge.reference import Known, Theory

__all__ = ["Known", "Quick", "Theory"]
