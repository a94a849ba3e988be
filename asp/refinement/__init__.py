"""Refinement: from a coarse description to a fine one that is tightly coupled to it (P 3.3)."""

from asp.refinement.language import parse_fine as parse_fine
from asp.refinement.refinement import CoarseDomain as CoarseDomain
from asp.refinement.refinement import Refinement as Refinement
from asp.refinement.refinement import load as load
from asp.refinement.refinement import load_refinement as load_refinement
from asp.refinement.refinement import read_refinement as read_refinement
from asp.refinement.refinement import refined_name as refined_name
from asp.refinement.refining import shared_places as shared_places
from asp.refinement.sensing import Sensing as Sensing
from asp.refinement.sensing import sensing_of as sensing_of
from asp.refinement.zooming import Transition as Transition
from asp.refinement.zooming import fine_constants as fine_constants
from asp.refinement.zooming import fine_goal as fine_goal
from asp.refinement.zooming import relevant as relevant
from asp.refinement.zooming import zoom as zoom
