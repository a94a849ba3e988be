"""Adversaries: who casts the exogenous actions. One file per strategy, one interface."""

from agents.adversary.base import Adversary as Adversary
from agents.adversary.base import AdversaryView as AdversaryView
from agents.adversary.base import Game as Game
from agents.adversary.base import Sight as Sight
from agents.adversary.random import RANDOM_RATE as RANDOM_RATE
from agents.adversary.random import Random as Random
from agents.adversary.scripted import Script as Script
from agents.adversary.scripted import Triggered as Triggered
