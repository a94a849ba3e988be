"""Types of the values of a configuration: how each is written, and its bounds."""

from collections.abc import Sequence
from typing import Annotated, Any

from pydantic import BaseModel, BeforeValidator, ConfigDict, Field, PlainSerializer, PlainValidator
from pydantic_core import PydanticCustomError

from asp.language import Literal

MOST = 2**31 - 1
"""The largest count: a solver calculates with 32 bits."""
LARGEST_SEED = 2**63 - 1
LONGEST_S = 31_536_000.0
"""The longest time: a year, which every clock and timer can measure."""
NONE = "none"
"""The scenario in which nothing exogenous happens, unless the domain has one of this name."""


class Section(BaseModel):
    """A part of a configuration: immutable, and a key it does not know is an error."""

    model_config = ConfigDict(extra="forbid", frozen=True)


def _literal(text: object) -> Literal:
    try:
        return Literal.parse("".join(text.split()) if isinstance(text, str) else "")
    except ValueError:
        example = "should be a literal such as f(a,b) or -f(a,b)"
        raise PydanticCustomError("literal", example) from None


def _whole(items: object) -> object:
    """Literals as one item each: YAML splits an unquoted `[loc(a,b)]` at the inner comma."""
    if not isinstance(items, Sequence) or isinstance(items, str):
        return items
    whole: list[Any] = []
    for item in items:
        if whole and isinstance(whole[-1], str) and whole[-1].count("(") > whole[-1].count(")"):
            whole[-1] = f"{whole[-1]},{item}"
        else:
            whole.append(item)
    return tuple(whole)


def _named(value: object) -> object:
    return str(value) if isinstance(value, int) and not isinstance(value, bool) else value


def _scenarios(value: object) -> object:
    """Nothing is what `none` stands for; null stands for what there is in the domain."""
    return () if value is None else [NONE] if value in ([], NONE) else value


def _listed(value: object) -> object:
    """A name by itself is a list of one; null is none."""
    return () if value is None else (value,) if isinstance(value, str | int) else value


LiteralText = Annotated[Literal, PlainValidator(_literal), PlainSerializer(str, return_type=str)]
"""A ground literal or action of a text."""
Literals = Annotated[tuple[LiteralText, ...], BeforeValidator(_whole)]
Name = Annotated[str, BeforeValidator(_named), Field(min_length=1)]
Count = Annotated[int, Field(strict=True, ge=1, le=MOST)]
Natural = Annotated[int, Field(strict=True, ge=0, le=MOST)]
Amount = Annotated[float, Field(strict=True, ge=0.0, le=1e9)]
Seconds = Annotated[float, Field(strict=True, gt=0.0, le=LONGEST_S)]
Probability = Annotated[float, Field(strict=True, ge=0.0, le=1.0)]
Flag = Annotated[bool, Field(strict=True)]
Scenarios = Annotated[tuple[Name, ...], BeforeValidator(_scenarios)]
Names = Annotated[tuple[Name, ...], BeforeValidator(_listed)]
