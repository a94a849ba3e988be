"""YAML as configurations have it: the core schema of YAML 1.2, with numbers in decimal.

YAML 1.1, which PyYAML reads by default, takes `010` for 8, `1:30` for 90, `no` for false and an
empty value for null. Here these are text, so that a key that needs a number refuses them.
"""

from __future__ import annotations

import re
from typing import Any, ClassVar

import yaml

MOST_NODES = 100_000
"""The most nodes of a document, each alias counted as what it stands for."""
MOST_DEPTH = 20
"""How deep lists and mappings may be nested: no key of a configuration needs as much."""
TAG = "tag:yaml.org,2002:"
INTEGER = r"0|-?[1-9][0-9]{0,99}"
FLOAT = r"-?(?:(?:0|[1-9][0-9]*)(?:\.[0-9]*(?:[eE][-+]?[0-9]+)?|[eE][-+]?[0-9]+)|\.[0-9]+)"
SCALARS = {
    "null": ("~|null|Null|NULL", "~nN"),
    "bool": ("true|True|TRUE|false|False|FALSE", "tTfF"),
    "int": (INTEGER, "-0123456789"),
    "float": (FLOAT, "-.0123456789"),
    "merge": ("<<", "<"),
}
"""By the type of a plain scalar its form, and the characters that it may begin with."""


class Loader(getattr(yaml, "CSafeLoader", yaml.SafeLoader)):  # type: ignore[misc]
    """Constructs plain values; the keys of mappings are text, as they are written."""

    yaml_implicit_resolvers: ClassVar[dict[str, Any]] = {}

    def construct_mapping(self, node: yaml.MappingNode, deep: bool = False) -> dict[Any, Any]:
        """Raises ConstructorError for a key that stands there twice."""
        lines: dict[str, int] = {}
        for key, _ in node.value:
            if not isinstance(key, yaml.ScalarNode):
                raise _refusal("a key is a name", key)
            if key.tag != TAG + "merge":
                key.tag = TAG + "str"
                if key.value in lines:
                    first = f"first in line {lines[key.value]}"
                    raise _refusal(f"the key {key.value} stands there twice; {first}", key)
                lines[key.value] = key.start_mark.line + 1
        constructed: dict[Any, Any] = super().construct_mapping(node, deep)
        return constructed

    def construct_document(self, node: yaml.Node) -> Any:
        """Raises ConstructorError where aliases expand to too much."""
        if _expanded(node, {}) > MOST_NODES:
            raise _refusal(f"its aliases stand for more than {MOST_NODES:,} values", node)
        return super().construct_document(node)


class Dumper(yaml.SafeDumper):
    """Puts into quotes what either version of YAML would take for something else than text."""


for _type, (_form, _first) in SCALARS.items():
    for _class in (Loader, Dumper):
        _class.add_implicit_resolver(TAG + _type, re.compile(f"(?:{_form})$"), list(_first))


def read_yaml(text: str) -> Any:
    """The value of a document; of an empty one the empty text. Raises YAMLError."""
    _check_depth(text)
    loader = Loader(text)
    try:
        node = loader.get_single_node()
        return "" if node is None else loader.construct_document(node)
    finally:
        loader.dispose()


def write_yaml(value: object) -> str:
    """A document that holds the value: keys in their order, lines of at most 100 characters.

    Where a character would steer what shows it, only ASCII is written, and escapes for the rest.
    """
    document = _written(value, allow_unicode=True)
    steers = any(not (own.isprintable() or own == "\n") for own in document)
    return _written(value, allow_unicode=False) if steers else document


def _written(value: object, allow_unicode: bool) -> str:
    return str(
        yaml.dump(value, Dumper=Dumper, sort_keys=False, width=100, allow_unicode=allow_unicode)
    )


def read_scalar(text: str) -> Any:
    """The value of a text that stands by itself, without quotes."""
    loader = Loader("")
    try:
        tag = loader.resolve(yaml.ScalarNode, text, (True, False))
        return loader.construct_object(yaml.ScalarNode(tag, text))
    finally:
        loader.dispose()


def _check_depth(text: str) -> None:
    """Raise YAMLError for what would be too deep for the recursion of a loader."""
    depth = 0
    for event in yaml.parse(text, Loader):
        depth += isinstance(event, yaml.CollectionStartEvent)
        depth -= isinstance(event, yaml.CollectionEndEvent)
        if depth > MOST_DEPTH:
            raise _refusal(f"is nested more than {MOST_DEPTH} deep", event)


def _expanded(node: yaml.Node, known: dict[yaml.Node, int]) -> int:
    """The number of nodes, aliases expanded; infinite where a node contains itself."""
    if node not in known:
        known[node] = MOST_NODES + 1  # unless it does not contain itself
        inner = node.value if isinstance(node, yaml.CollectionNode) else ()
        nodes = [part for item in inner for part in (item if isinstance(item, tuple) else (item,))]
        known[node] = 1 + sum(_expanded(part, known) for part in nodes)
    return known[node]


def _refusal(problem: str, at: Any) -> yaml.YAMLError:
    return yaml.constructor.ConstructorError(None, None, problem, at.start_mark)
