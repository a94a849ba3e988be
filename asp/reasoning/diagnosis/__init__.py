"""Smallest explanations of histories: the reference, and the incremental twin held equal to it."""

from asp.reasoning.diagnosis.explanations import (
    Diagnoser,
    Diagnosis,
    Explanation,
    H_contra,
    InconsistentHistoryError,
)
from asp.reasoning.diagnosis.history import GOAL, SELECT, Happening, History, problem_of, record_of
from asp.reasoning.diagnosis.inconsistency import (
    cannot_hold,
    conflict,
    distrust_tests,
    never_together,
)
from asp.reasoning.diagnosis.incremental import DiagnosisSessions, IncrementalDiagnoser
from asp.reasoning.diagnosis.long_histories.frontier import Compression
from asp.reasoning.diagnosis.reference import ReferenceDiagnoser, diagnosis_of, event_limits

__all__ = [
    "GOAL",
    "SELECT",
    "Compression",
    "Diagnoser",
    "Diagnosis",
    "DiagnosisSessions",
    "Explanation",
    "H_contra",
    "Happening",
    "History",
    "InconsistentHistoryError",
    "IncrementalDiagnoser",
    "ReferenceDiagnoser",
    "cannot_hold",
    "conflict",
    "diagnosis_of",
    "distrust_tests",
    "event_limits",
    "never_together",
    "problem_of",
    "record_of",
]
