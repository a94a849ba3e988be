"""Shortest plans at the fine resolution."""
