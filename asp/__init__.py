"""The action language AL_d, its translation to answer set programs, and the theories."""

from asp.language.description import Description
from asp.language.errors import SourceError
from asp.language.loading import load_description, parse_description

DISTRIBUTION = "intention-testbed"

__all__ = ["Description", "SourceError", "load_description", "parse_description"]
