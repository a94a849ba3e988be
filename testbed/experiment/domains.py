"""The domains of this process, each loaded and compiled once."""

from __future__ import annotations

from functools import lru_cache

import asp
from testbed.world import World, world_of


@lru_cache(maxsize=8)
def load_world(domain: str) -> World:
    """The world of a domain given by name or path. Raises what `asp.load_description` does."""
    return world_of(asp.load_description(domain))
