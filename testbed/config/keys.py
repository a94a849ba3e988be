"""The keys of a configuration with their types and defaults, read off the models."""

from __future__ import annotations

import inspect
from collections.abc import Callable, Iterator, Mapping
from typing import Any, TypeVar

from testbed.config.models import ExperimentConfig

Schema = Mapping[str, Any]
F = TypeVar("F", bound=Callable[..., object])

_TYPES = {"integer": "int", "number": "float", "string": "str", "boolean": "bool", "null": "None"}


def listed_keys() -> Iterator[str]:
    """One line per key: `name: type = default`; of a section the names of its own keys."""
    schema = ExperimentConfig.model_json_schema()
    for name, own in schema["properties"].items():
        plain = "default" in own and not isinstance(own["default"], dict)
        yield f"{name}: {_type(own, schema)}" + (f" = {own['default']!r}" if plain else "")


def lists_keys(function: F) -> F:
    """A decorator: the docstring ends with the keys, each of which is a keyword argument, too."""
    keys = "\n".join(f"    {line}" for line in listed_keys())
    title = "Keyword arguments beside these are keys of the configuration:"
    function.__doc__ = f"{inspect.cleandoc(function.__doc__ or '')}\n\n{title}\n\n{keys}\n"
    return function


def _type(own: Schema, schema: Schema) -> str:
    if "$ref" in own:
        section = schema["$defs"][own["$ref"].rpartition("/")[2]]["properties"]
        return "{" + ", ".join(section) + "}"
    if "anyOf" in own:
        return " | ".join(dict.fromkeys(_type(one, schema) for one in own["anyOf"]))
    if "enum" in own:
        return " | ".join(map(repr, own["enum"]))
    if own.get("type") == "array":
        items = own.get("prefixItems") or [own["items"]]
        return f"list of {', '.join(dict.fromkeys(_type(item, schema) for item in items))}"
    if own.get("type") == "object":
        return f"names with {_type(own['additionalProperties'], schema)}"
    return _TYPES.get(str(own.get("type")), "any")
