"""The intentional robot: the adapted theory of intentions in the loop AIA (P 3.2)."""

from agents.intentional.controller import IntentionalRobot as IntentionalRobot
from agents.intentional.programs import Watched as Watched
from agents.intentional.programs import program_of as program_of
