"""The action language AL_d, its translation to answer set programs, and the theories."""

from asp.language import Description, SourceError, load_description, parse_description

DISTRIBUTION = "intention-testbed"

__all__ = ["Description", "SourceError", "load_description", "parse_description"]
