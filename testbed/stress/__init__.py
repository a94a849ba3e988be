"""Stress tests: search for episodes in which a robot fails, and for the simplest of each kind."""

from testbed.experiment.episodes import Episode as Episode
from testbed.experiment.episodes import Player as Player
from testbed.stress.objectives import OBJECTIVES as OBJECTIVES
from testbed.stress.stories import findings as findings
from testbed.stress.verdicts import Finding as Finding
from testbed.stress.verdicts import Verdict as Verdict
