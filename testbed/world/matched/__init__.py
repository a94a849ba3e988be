"""A world whose laws are matched against what is true, and never instantiated as a whole."""

from testbed.world.matched.world import SparseWorld

__all__ = ["SparseWorld"]
