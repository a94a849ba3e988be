"""Adversaries: who casts the exogenous actions. One file a strategy, one interface."""
