"""Statistics of the trials of a run."""
