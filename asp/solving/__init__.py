"""Solving programs with clingo, within a budget, in one call or over many."""
