"""The transition diagram of a domain: one interface, and two backends that find its answers."""

from testbed.world.backends import load_world, world_of
from testbed.world.world import (
    NotExecutableError,
    StateError,
    UnknownActionError,
    UnknownFluentError,
    World,
    bits,
)

__all__ = [
    "NotExecutableError",
    "StateError",
    "UnknownActionError",
    "UnknownFluentError",
    "World",
    "bits",
    "load_world",
    "world_of",
]
