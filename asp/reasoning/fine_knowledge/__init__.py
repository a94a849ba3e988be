"""Knowledge at the fine resolution, and the inferences from it."""

from asp.reasoning.fine_knowledge.incremental import (
    IncrementalFineKnowledge as IncrementalFineKnowledge,
)
from asp.reasoning.fine_knowledge.reference import FineKnowledge as FineKnowledge
from asp.reasoning.fine_knowledge.reference import Known as Known
from asp.reasoning.fine_knowledge.reference import ReferenceFineKnowledge as ReferenceFineKnowledge
