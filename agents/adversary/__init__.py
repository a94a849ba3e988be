"""Adversaries: who casts the exogenous actions. One file per strategy, one interface."""

from agents.adversary.base import Adversary as Adversary
from agents.adversary.base import AdversaryView as AdversaryView
from agents.adversary.base import Events as Events
from agents.adversary.base import Game as Game
from agents.adversary.base import Measure as Measure
from agents.adversary.base import Occurrence as Occurrence
from agents.adversary.base import Rehearsal as Rehearsal
from agents.adversary.base import Remaining as Remaining
from agents.adversary.base import Sight as Sight
from agents.adversary.belief import Belief as Belief
from agents.adversary.greedy import Greedy as Greedy
from agents.adversary.human import Human as Human
from agents.adversary.learned import Learned as Learned
from agents.adversary.meddler import Meddler as Meddler
from agents.adversary.none import Nothing as Nothing
from agents.adversary.optimal import Optimal as Optimal
from agents.adversary.random import RANDOM_RATE as RANDOM_RATE
from agents.adversary.random import Random as Random
from agents.adversary.scripted import Script as Script
from agents.adversary.scripted import Triggered as Triggered
