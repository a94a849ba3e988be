"""A lower bound on what is left to do, for the oracle's search: potentials of the world's laws."""

from testbed.experiment.heuristic.potentials import Heuristic, Potentials, blind

__all__ = ["Heuristic", "Potentials", "blind"]
