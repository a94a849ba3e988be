"""The transition diagram of a domain: one interface, and two backends that find its answers."""

from functools import cache, lru_cache

from asp.language import Description, Problems, load_description, signature_of, syntax
from asp.refinement import Refinement
from testbed.world.closure import bits as bits
from testbed.world.compiled import CompiledWorld
from testbed.world.errors import NotExecutableError as NotExecutableError
from testbed.world.errors import StateError as StateError
from testbed.world.errors import UnknownActionError as UnknownActionError
from testbed.world.errors import UnknownFluentError as UnknownFluentError
from testbed.world.matched.world import MatchedWorld
from testbed.world.world import World as World


def world_of(description: Description | Refinement | syntax.Source) -> World:
    """The world of a description.

    A ground description is compiled. A checked text is not instantiated, and its laws are matched
    instead: they may have too many instances. The world of a refinement is that of its weak
    description, the physics of the fine resolution, made once.
    """
    if isinstance(description, Description):
        return CompiledWorld(description)
    if isinstance(description, Refinement):
        return _weak(description)
    return MatchedWorld(description, signature_of(description, Problems(description.file)))


@lru_cache(maxsize=8)
def load_world(domain: str) -> World:
    """The world of a domain given by name or path. Raises what `asp.load_description` does."""
    return world_of(load_description(domain))


@cache
def _weak(refinement: Refinement) -> MatchedWorld:
    return MatchedWorld(refinement.weak, refinement.weak_signature)
