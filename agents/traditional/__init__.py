"""The traditional planning baseline TP (P 4)."""

from agents.traditional.robot import TraditionalRobot as TraditionalRobot
