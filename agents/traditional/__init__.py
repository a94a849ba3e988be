"""The traditional planning baseline TP (spec 2, last table)."""

from agents.traditional.robot import TraditionalRobot

__all__ = ["TraditionalRobot"]
