"""Statistics of the trials of a run, which `load_run` reads into one table."""

from testbed.analysis.table import Run, load_run

__all__ = ["Run", "load_run"]
