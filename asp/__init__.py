"""The action language AL_d, its translation to answer set programs, and the theories."""

from typing import TYPE_CHECKING, Any

from asp.language import Description as Description
from asp.language import DomainError as DomainError
from asp.language import SourceError as SourceError
from asp.language import load_description as load_description
from asp.language import parse_description as parse_description

if TYPE_CHECKING:
    from asp.reasoning import Domain as Domain
    from asp.reasoning import Step as Step
    from asp.reasoning import load as load

DISTRIBUTION = "intention-testbed"


def __getattr__(name: str) -> Any:
    """`Domain`, `Step` and `load`, looked up when they are asked for: they take long to import."""
    if name in ("Domain", "Step", "load"):
        from asp import reasoning  # noqa: PLC0415

        return getattr(reasoning, name)
    raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
