"""Refinement: from a coarse description to a fine one that is tightly coupled to it (P 3.3)."""

from asp.refinement.reading import load_refinement
from asp.refinement.refinement import Refinement, load

__all__ = ["Refinement", "load", "load_refinement"]
