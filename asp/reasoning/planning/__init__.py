"""Shortest plans at the coarse resolution."""
