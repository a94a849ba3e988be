"""Refinement: from a coarse description to a fine one that is tightly coupled to it (P 3.3)."""

from asp.refinement.language import parse_fine
from asp.refinement.refinement import (
    Refinement,
    load,
    load_refinement,
    read_refinement,
    refined_name,
)
from asp.refinement.refining import shared_places
from asp.refinement.sensing import Sensing, sensing_of
from asp.refinement.zooming import Transition, fine_constants, fine_goal, relevant, zoom

__all__ = [
    "Refinement",
    "Sensing",
    "Transition",
    "fine_constants",
    "fine_goal",
    "load",
    "load_refinement",
    "parse_fine",
    "read_refinement",
    "refined_name",
    "relevant",
    "sensing_of",
    "shared_places",
    "zoom",
]
