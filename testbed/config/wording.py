"""One line per error that pydantic found in a document: its place, and what would be right."""

import json
import re
from collections.abc import Iterable, Iterator
from functools import partial
from typing import Any, get_args, get_type_hints

from pydantic import ValidationError
from pydantic_core import ErrorDetails

from asp.language import nearest, suggestion
from testbed.config.places import ConfigError, Key, Places
from testbed.config.values import Section

LONGEST = 80
"""How much of a value a line shows."""

FORMS = {
    "int_type": "; write it in decimal digits alone, without quotes",
    "float_type": "; write it in decimal, without quotes",
    "bool_type": "; write true or false",
    "string_type": "; put it in quotes",
}
"""How the values of a type are written, by the error that they are not of it."""

LIKE_A_VALUE = re.compile(r"^[-+.]*\d|^\.(inf|nan)$|^(y|n|yes|no|on|off)$", re.IGNORECASE)
"""Texts that YAML 1.1 reads as a number or a truth value."""

FINE_KEYS = ("levels", "level_sizes", "refinement", "draw", "statistics")
"""Keys that only configurations of the fine resolution have."""


def refusal(error: ValidationError, places: Places, root: type[Section]) -> ConfigError:
    """What is wrong with a document that should be a `root`."""
    found = error.errors(include_url=False)
    cut = {item["loc"][:-1] for item in found if _is_rest_of_literal(item)}
    kept = (item for item in found if item["type"] != "literal" or item["loc"][:-1] not in cut)
    meant = set(map(partial(_meant_key, root), found))
    told = (item for item in kept if item["type"] != "missing" or item["loc"] not in meant)
    return ConfigError([_describe(item, places, root) for item in told])


def _is_rest_of_literal(error: ErrorDetails) -> bool:
    """Whether a key is what YAML cut off from an unquoted literal, at a comma."""
    return error["type"] == "extra_forbidden" and ")" in str(error["loc"][-1])


def _meant_key(root: type[Section], error: ErrorDetails) -> Key | None:
    """The key that an unknown one is a misspelling of; None: none, or it is known."""
    if error["type"] != "extra_forbidden":
        return None
    *section, name = error["loc"]
    near = nearest(str(name), _fields_of(root, section))
    return None if near is None else (*section, near)


def _describe(error: ErrorDetails, places: Places, root: type[Section]) -> str:
    key = error["loc"]
    where = places.of(key)
    if error["type"] == "extra_forbidden":
        return f"{where}: unknown key; {_known_key(root, key)}"
    if error["input"] == "":
        return f"{where}: has no value; give one, or null for none"
    if error["type"] == "sweep":
        return f"{where}: {error['msg']}"
    if error["type"] == "missing":
        return f"{where}: is missing{_example(root, key)}{_or_level(key, error['input'])}"
    if error["type"] == "too_short":
        return f"{where}: should not be empty{_example(root, key)}"
    if error["type"] == "tuple_type":
        return f"{where}: should be a list such as [{_shown(error['input'])}]"
    message = error["msg"].removeprefix("Input ").replace("a valid integer", "an integer")
    message = message.replace("a valid ", "a ").replace("dictionary", "mapping")
    message = message[0].lower() + message[1:].partition(" or instance of")[0]
    return f"{where}: {message}, not {_shown(error['input'])}{_hint(error)}"


def _shown(value: object) -> str:
    """A value as YAML writes it, of a long one the beginning."""
    if value is None or isinstance(value, bool):
        return json.dumps(value)
    text = repr(value)
    return text if len(text) <= LONGEST else f"{text[:LONGEST]}..."


def _example(root: type[Section], key: Key) -> str:
    field = root.model_fields.get(str(key[0])) if len(key) == 1 else None
    return f"; for example {field.examples[0]}" if field and field.examples else ""


def _or_level(key: Key, given: Any) -> str:
    """Of a goal that is missing beside what belongs to levels: these may be what is."""
    if key != ("goal",) or not any(name in given for name in FINE_KEYS):
        return ""
    return "; or give levels, as in levels: [L1], or a refinement: there goals are drawn"


def _hint(error: ErrorDetails) -> str:
    """What would be right: the form that the type has in YAML, or the nearest choice."""
    given = error["input"]
    if error["type"] in FORMS and (
        isinstance(given, float | int) or LIKE_A_VALUE.search(str(given))
    ):
        return FORMS[error["type"]]
    expected = error.get("ctx", {}).get("expected")
    if expected is None or not isinstance(given, str):
        return ""
    choices = str(expected).replace("'", "").replace(" or ", ", ").split(", ")
    near = suggestion(given, choices, otherwise="")
    return near and f"; {near}"


def _known_key(root: type[Section], key: Key) -> str:
    """What an unknown key should be: in quotes, or one of its section."""
    if "(" in str(key[-1]) or ")" in str(key[-1]):
        return "put quotes around an action or a literal with a comma in it"
    return suggestion(str(key[-1]), _fields_of(root, key[:-1]))


def _fields_of(root: type[Section], key: Iterable[str | int]) -> Iterable[str]:
    """The keys of the section that a key leads to."""
    section = root
    for part in key:  # a name or a number in a mapping or a list of sections leads to no other one
        section = next(_sections(get_type_hints(section).get(str(part))), section)
    return section.model_fields


def _sections(annotation: Any) -> Iterator[type[Section]]:
    """The sections in an annotation such as `tuple[OwnSection, ...] | None`."""
    if isinstance(annotation, type) and issubclass(annotation, Section):
        yield annotation
    for part in get_args(annotation):
        yield from _sections(part)
