"""Shortest plans at the fine resolution."""

from asp.reasoning.fine_planning.incremental import Horizons as Horizons
from asp.reasoning.fine_planning.incremental import IncrementalFinePlanner as IncrementalFinePlanner
from asp.reasoning.fine_planning.incremental import fine_planner as fine_planner
from asp.reasoning.fine_planning.reference import FinePlan as FinePlan
from asp.reasoning.fine_planning.reference import FineStart as FineStart
from asp.reasoning.fine_planning.reference import LiteralProblem as LiteralProblem
from asp.reasoning.fine_planning.reference import NoPlan as NoPlan
from asp.reasoning.fine_planning.reference import ReferenceFinePlanner as ReferenceFinePlanner
