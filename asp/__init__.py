"""The action language AL_d, its translation to answer set programs, and the theories."""

from asp.language import Description as Description
from asp.language import SourceError as SourceError
from asp.language import load_description as load_description
from asp.language import parse_description as parse_description

DISTRIBUTION = "intention-testbed"
