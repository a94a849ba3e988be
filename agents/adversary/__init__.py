"""Adversaries: who casts the exogenous actions. One file a strategy, one interface."""

from agents.adversary.base import Adversary, AdversaryView, Game, Sight
from agents.adversary.random import RANDOM_RATE, Random
from agents.adversary.scripted import Script, Triggered

__all__ = [
    "RANDOM_RATE",
    "Adversary",
    "AdversaryView",
    "Game",
    "Random",
    "Script",
    "Sight",
    "Triggered",
]
