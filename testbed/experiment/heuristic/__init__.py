"""A lower bound on what is left to do, for the judge's search: potentials of the world's laws."""
