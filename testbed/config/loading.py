"""Read a configuration: OmegaConf composes file and overrides, pydantic validates the result."""

import inspect
import re
from collections.abc import Callable, Iterator, Mapping, Sequence
from pathlib import Path
from typing import Any, TypeVar, get_type_hints

from pydantic import ValidationError

from asp.language import load_description, suggestion
from testbed.config import models
from testbed.config.checking import Check, check
from testbed.config.composing import REFUSALS, compose
from testbed.config.conditions import varied
from testbed.config.models import ExperimentConfig
from testbed.config.places import ConfigError, Places
from testbed.config.scenarios import with_scenarios
from testbed.config.values import Section
from testbed.config.wording import refusal

F = TypeVar("F", bound=Callable[..., object])

SECTION = re.compile(rf"{re.escape(__package__)}\.\w+\.(\w+)")
"""A section, as types are written."""


def load_config(
    source: str | Path,
    overrides: Sequence[str] = (),
    checks: Sequence[Check] = (),
    given_in: str = "command line",
) -> ExperimentConfig:
    """The validated configuration of a file or a packaged name, with dotted overrides applied.

    A `domain` given as a path, and a `refinement`, are taken relative to the configuration, and
    are absolute in the answer. `checks` are those of what the configuration calls by name, such
    as its robots. `given_in` is what errors call the place of the overrides.

    Raises:
        ConfigError: one line per error, each with its place and what would be right.
    """
    try:
        path = find_config(source)
        text = path.read_text(encoding="utf-8")
    except UnicodeDecodeError as error:
        raise ConfigError([f"{source}: not a text file in UTF-8 ({error.reason})"]) from None
    except OSError as error:
        message = str(error) if error.strerror is None else f"{source}: {error.strerror}"
        raise ConfigError([message]) from None
    places = Places(path, text, [item.partition("=")[0] for item in overrides], given_in)
    config = validated(compose(text, overrides, places), path, places, checks)
    if config.is_sweep:
        _refuse_without_effect(config, overrides, given_in)
        for name, keys in config.sweep.cells.items():
            own = Places(path, text, list(keys), f"{places.of(('sweep',))}: {name}", places)
            validated(_varied(config, keys, own), path, own, checks)
    return config


def _refuse_without_effect(
    config: ExperimentConfig, overrides: Sequence[str], given_in: str
) -> None:
    """Refuse overrides of keys that every condition sets. Raises ConfigError, a line for each."""
    swept = frozenset.intersection(*(frozenset(own) for own in config.sweep.cells.values()))
    told = "is varied by the sweep; 'sweep={}' plays this value alone, '-m' others"
    lost = [key for key in (item.partition("=")[0] for item in overrides) if key in swept]
    if lost:
        raise ConfigError([f"{given_in}: {key}: {told}" for key in lost])


def _varied(config: ExperimentConfig, keys: Mapping[str, Any], places: Places) -> dict[str, Any]:
    """The keys under a condition. Raises ConfigError for one that leads nowhere."""
    try:
        return varied(config, keys)
    except (*REFUSALS, ValueError, TypeError, IndexError) as error:
        raise ConfigError([f"{places.elsewhere}: {str(error).splitlines()[0]}"]) from None


def validated(
    composed: dict[str, Any], path: Path, places: Places, checks: Sequence[Check]
) -> ExperimentConfig:
    """The configuration that these keys are; `path` is the file that they stand in.

    Raises:
        ConfigError: one line per error, each with its place.
    """
    try:
        config = _located(ExperimentConfig.model_validate(composed), path)
    except ValidationError as error:
        raise refusal(error, places, ExperimentConfig) from None
    check(config, places, checks)
    if config.is_fine:
        return config
    return with_scenarios(config, load_description(config.domain).scenarios)


def _located(config: ExperimentConfig, path: Path) -> ExperimentConfig:
    """With the paths of files beside the configuration, or here; a packaged one keeps its name."""
    files = {"refinement": config.refinement} if config.refinement is not None else {}
    if config.domain.endswith(".al"):
        files["domain"] = config.domain
    located = {key: _beside(path, file) for key, file in files.items()}
    tls = {key: _beside(path, file) for key, file in config.tls.files.items()}
    return config.model_copy(update={**located, "tls": config.tls.model_copy(update=tls)})


def _beside(path: Path, file: str) -> str:
    found = filter(Path.is_file, (path.parent / file, Path(file)))
    return str(next((candidate.resolve() for candidate in found), file))


SUFFIX = ".yaml"


def config_folder() -> Path:
    """The folder of the packaged configurations.

    A wheel carries them inside the package; a checkout keeps them beside it.
    """
    package = Path(__file__).resolve().parent.parent
    inside = package / "configs"
    return inside if inside.is_dir() else package.parent / "configs"


def config_names() -> list[str]:
    """Names under which a packaged configuration can be asked for, sorted."""
    return sorted(path.stem for path in config_folder().glob("*" + SUFFIX))


def find_config(source: str | Path) -> Path:
    """Path of a configuration given by path or by bare name (`quickstart`).

    Raises:
        FileNotFoundError: with one line that names the nearest packaged configurations.
    """
    path = Path(source)
    if path.is_file():
        return path
    if path.is_dir():
        raise FileNotFoundError(f"{source}: is a folder; a configuration is a {SUFFIX} file")
    packaged = config_folder() / (path.name + SUFFIX)
    if path.name == str(source) and packaged.is_file():
        return packaged
    raise FileNotFoundError(f"{source}: no such file; {suggestion(path.stem, config_names())}")


def listed_keys() -> Iterator[str]:
    """One line per key: `name: type = default`; of a section the names of its own keys."""
    types = get_type_hints(ExperimentConfig)
    for name, own in ExperimentConfig.model_fields.items():
        kind = SECTION.sub(_keys_of, inspect.formatannotation(types[name]))
        plain = own.default_factory is None and not isinstance(own.default, Section)
        yield f"{name}: {kind}" + (f" = {own.default!r}" if plain and not own.is_required() else "")


def _keys_of(section: re.Match[str]) -> str:
    return f"{{{', '.join(getattr(models, section[1]).model_fields)}}}"


def lists_keys(function: F) -> F:
    """A decorator: the docstring ends with the keys, each of which is a keyword argument, too."""
    keys = "\n".join(f"    {line}" for line in listed_keys())
    title = "Keyword arguments beside these are keys of the configuration:"
    function.__doc__ = f"{inspect.cleandoc(function.__doc__ or '')}\n\n{title}\n\n{keys}\n"
    return function
