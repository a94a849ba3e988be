"""What a robot knows at the fine resolution, and what follows from it."""

from asp.reasoning.fine_knowledge.incremental import IncrementalFineKnowledge
from asp.reasoning.fine_knowledge.reference import FineKnowledge, Known, ReferenceFineKnowledge

__all__ = ["FineKnowledge", "IncrementalFineKnowledge", "Known", "ReferenceFineKnowledge"]
