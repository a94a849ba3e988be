"""Smallest explanations of histories: the reference, and the incremental twin held equal to it."""

from asp.reasoning.diagnosis.belief import Belief as Belief
from asp.reasoning.diagnosis.explanations import Diagnoser as Diagnoser
from asp.reasoning.diagnosis.explanations import Diagnosis as Diagnosis
from asp.reasoning.diagnosis.explanations import Explanation as Explanation
from asp.reasoning.diagnosis.explanations import H_contra as H_contra
from asp.reasoning.diagnosis.explanations import (
    InconsistentHistoryError as InconsistentHistoryError,
)
from asp.reasoning.diagnosis.history import GOAL as GOAL
from asp.reasoning.diagnosis.history import SELECT as SELECT
from asp.reasoning.diagnosis.history import Happening as Happening
from asp.reasoning.diagnosis.history import History as History
from asp.reasoning.diagnosis.history import problem_of as problem_of
from asp.reasoning.diagnosis.history import record_of as record_of
from asp.reasoning.diagnosis.inconsistency import cannot_hold as cannot_hold
from asp.reasoning.diagnosis.inconsistency import conflict as conflict
from asp.reasoning.diagnosis.inconsistency import distrust_tests as distrust_tests
from asp.reasoning.diagnosis.inconsistency import never_together as never_together
from asp.reasoning.diagnosis.incremental import IncrementalDiagnoser as IncrementalDiagnoser
from asp.reasoning.diagnosis.initial_states import beyond_observed as beyond_observed
from asp.reasoning.diagnosis.long_histories.frontier import Compression as Compression
from asp.reasoning.diagnosis.reference import ReferenceDiagnoser as ReferenceDiagnoser
from asp.reasoning.diagnosis.reference import diagnosis_of as diagnosis_of
from asp.reasoning.diagnosis.reference import event_limits as event_limits
from asp.reasoning.diagnosis.sessions import DiagnosisSessions as DiagnosisSessions
