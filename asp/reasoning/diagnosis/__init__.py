"""Smallest explanations of histories."""

from asp.reasoning.diagnosis.encoding import Account, Assumed, Past, Record
from asp.reasoning.diagnosis.inconsistency import cannot_hold, conflict, misreadings, never_together
from asp.reasoning.diagnosis.incremental import Explanations
from asp.reasoning.diagnosis.long_histories.compression import Folding, Pace
from asp.reasoning.diagnosis.long_histories.suffix_explanations import Windows

__all__ = [
    "Account",
    "Assumed",
    "Explanations",
    "Folding",
    "Pace",
    "Past",
    "Record",
    "Windows",
    "cannot_hold",
    "conflict",
    "misreadings",
    "never_together",
]
