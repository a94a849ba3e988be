"""Types of what a message may hold: bounded, so that what a robot says can be kept and counted.

Whatever breaks a bound is not understood (`messages.decode`).
"""

from typing import Annotated, TypeAlias, TypeVar

from msgspec import Meta

from asp.language import Literal

MOST_BYTES = 4 * 2**20
"""Of one message."""
MOST_CHARACTERS = 10_000
MOST_ITEMS = 100_000
LARGEST = 2**31 - 1

Text: TypeAlias = Annotated[str, Meta(max_length=MOST_CHARACTERS)]
Count: TypeAlias = Annotated[int, Meta(ge=0, le=LARGEST)]
"""A number of things, or a step."""
Seconds: TypeAlias = Annotated[float, Meta(ge=0.0, le=1e9)]
"""A finite time: neither NaN nor an infinity is within the bounds."""

T = TypeVar("T")
Items: TypeAlias = Annotated[list[T], Meta(max_length=MOST_ITEMS)]


def literal_within_bounds(_kind: type, value: object) -> Literal:
    """The literal of a text that came in. Raises ValueError where it is too long, or none."""
    if not isinstance(value, str):
        raise ValueError(f"expected the text of a literal, got {type(value).__name__}")
    if len(value) > MOST_CHARACTERS:
        raise ValueError(f"a literal of {len(value)} characters; {MOST_CHARACTERS} are the most")
    return Literal.parse(value)


def shortened(text: str, most: int = MOST_CHARACTERS) -> str:
    """The text, cut at its end if it is longer than `most` characters."""
    return text if len(text) <= most else f"{text[: most - 3]}..."
