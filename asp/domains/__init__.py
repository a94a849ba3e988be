"""Packaged domains: one AL_d text per domain, and the levels L1 to L8 made of texts (P 4)."""

from asp.domains.levels import LEVELS as LEVELS
from asp.domains.levels import LevelSize as LevelSize
from asp.domains.levels import level_text as level_text
