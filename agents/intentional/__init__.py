"""The intentional robot: the adapted theory of intentions in the loop AIA (spec 2)."""

from agents.intentional.controller import IntentionalRobot

__all__ = ["IntentionalRobot"]
