"""The action language AL_d, its translation to answer set programs, and the theories."""

from asp.description import Description
from asp.errors import SourceError
from asp.loading import load_description, parse_description

DISTRIBUTION = "intention-testbed"

__all__ = ["Description", "SourceError", "load_description", "parse_description"]
