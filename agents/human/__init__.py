"""A robot that a person plays."""

from agents.human.robot import PERSON as PERSON
from agents.human.robot import Human as Human
