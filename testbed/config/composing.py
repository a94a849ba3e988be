"""Compose a configuration: the keys of a file, overrides of them, and interpolations in both.

Files are in the core schema of YAML 1.2, with numbers in decimal. YAML 1.1, which PyYAML reads by
default, takes `010` for 8, `1:30` for 90, `no` for false and an empty value for null. Here these
are text, so that a key that needs a number refuses them.
"""

import re
from collections.abc import Mapping, Sequence
from functools import partial
from typing import Any, ClassVar

import yaml
from omegaconf import DictConfig, OmegaConf
from omegaconf.errors import OmegaConfBaseException

from asp.language import Literal
from testbed.config.models import FINE_STEPS, ExperimentConfig
from testbed.config.places import ConfigError, Places, parsed
from testbed.config.sections import Limits

MOST_NODES = 100_000
"""The most nodes of a document, each alias counted as what it stands for."""
MOST_DEPTH = 20
"""How deep lists and mappings may be nested: no key of a configuration needs as much."""
REFUSALS = (yaml.YAMLError, OmegaConfBaseException, RecursionError)
"""The errors of both libraries for text that they cannot read."""
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


# To PyYAML a literal, which is text with parts, is text: here, and where a user writes records.
yaml.SafeDumper.add_representer(Literal, yaml.SafeDumper.represent_str)


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
    write = partial(yaml.dump, value, Dumper=Dumper, sort_keys=False, width=100)
    document = str(write(allow_unicode=True))
    if all(own.isprintable() or own == "\n" for own in document):
        return document
    return str(write(allow_unicode=False))


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


def compose(text: str, overrides: Sequence[str], places: Places) -> dict[str, Any]:
    """The keys and values of a text in YAML with dotted overrides, interpolations resolved.

    Raises:
        ConfigError: one line for the first thing that cannot be read or resolved.
    """
    try:
        found = read_yaml(text) or {}
        if not isinstance(found, dict):
            raise ConfigError([f"{places.file}: should hold `key: value` lines"])
        composed = OmegaConf.create(found)
    except yaml.YAMLError as error:
        raise ConfigError([_yaml_line(places.file, error)]) from None
    except (OmegaConfBaseException, RecursionError) as error:
        raise ConfigError([f"{places.file}: {_first_line(error)}"]) from None
    for item in overrides:
        _override(composed, item, places)
    given: Any = OmegaConf.to_container(composed)
    values: dict[str, Any] = _as_given(given, _resolved(given, places))
    return values


def _override(composed: DictConfig, item: str, places: Places) -> None:
    key, equals, value = item.partition("=")
    if not (equals and key.strip()):
        wanted = f"'{item}': an override is KEY=VALUE, e.g. limit=5"
        raise ConfigError([f"{places.elsewhere}: {wanted}"])
    try:
        given = read_yaml(value)
        OmegaConf.update(composed, key.strip(), given, merge=given != {}, force_add=True)
    except (*REFUSALS, ValueError, TypeError, IndexError) as error:
        problem = getattr(error, "problem", None) or _first_line(error)
        raise ConfigError([f"{places.elsewhere}: {key}: {problem}"]) from None


def _resolved(given: Mapping[str, Any], places: Places) -> Any:
    """The values with interpolations resolved, which may be of keys that were not given."""
    fine = given.get("levels") or given.get("refinement")
    limits = Limits(steps=FINE_STEPS) if fine else Limits()
    blank = ExperimentConfig.model_construct(name="", goal=(), limits=limits)
    defaults = blank.model_dump(mode="json", exclude={"name", "goal", "sweep"})
    try:
        everything = OmegaConf.merge(defaults, given)
        return OmegaConf.to_container(everything, resolve=True, throw_on_missing=True)
    except REFUSALS as error:
        key = parsed(getattr(error, "full_key", None) or "")
        raise ConfigError([f"{places.of(key)}: {_first_line(error)}"]) from None


def _as_given(given: Any, resolved: Any) -> Any:
    """The part that was given; the text of an interpolation is read as if it stood there."""
    if isinstance(given, dict):
        return {key: _as_given(value, resolved[key]) for key, value in given.items()}
    if isinstance(given, list):
        return [_as_given(*both) for both in zip(given, resolved, strict=True)]
    interpolated = isinstance(resolved, str) and resolved != given
    return read_scalar(resolved) if interpolated else resolved


def _yaml_line(file: str, error: yaml.YAMLError) -> str:
    mark = getattr(error, "problem_mark", None)
    where = f"{file}:{mark.line + 1}:{mark.column + 1}" if mark else file
    return f"{where}: not YAML: {getattr(error, 'problem', None) or _first_line(error)}"


def _first_line(error: Exception) -> str:
    return str(error).strip().splitlines()[0] if str(error).strip() else type(error).__name__
