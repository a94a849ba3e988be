"""The transition diagram of a domain: one interface, and two backends that find its answers."""

from testbed.world.backends import load_world, world_of
from testbed.world.world import (
    NotExecutableError,
    StateError,
    UnknownActionError,
    UnknownFluentError,
    World,
)

__all__ = [
    "NotExecutableError",
    "StateError",
    "UnknownActionError",
    "UnknownFluentError",
    "World",
    "load_world",
    "world_of",
]
