"""The configuration in a run folder: what is needed to go on with the run, or to run it again."""

from __future__ import annotations

import shutil
from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path

from testbed.config import (
    SCENARIO_KEYS,
    ConfigError,
    ExperimentConfig,
    load_config,
    write_yaml,
)
from testbed.experiment.errors import StoreError
from testbed.experiment.run_folder import CONFIG, naming, replace_text

ANY_RESULT = ("link", "limits.answer_s")  # keys on which no logical result depends
MOST_CHANGES = 8
OWN_FILES = ("domain", "refinement")
"""Keys that may lead to a file which is not packaged."""
TEXT = " text"
"""After the key of such a file: its text, which is no key of a configuration."""


def read_config(folder: Path) -> ExperimentConfig:
    """The configuration stored in a run folder. Raises StoreError or ConfigError."""
    if not (folder / CONFIG).is_file():
        raise StoreError(f"{folder}: is not a run folder (it has no {CONFIG})")
    return load_config(folder / CONFIG)


def write_config(folder: Path, config: ExperimentConfig) -> None:
    """Write the resolved configuration, and beside it a domain or map that is not packaged."""
    folder.mkdir(parents=True, exist_ok=True)
    files = _own_files(config)
    for source in files.values():
        if source.parent != folder.resolve():
            with naming(folder / source.name):
                shutil.copyfile(source, folder / source.name)
    config = config.model_copy(update={key: source.name for key, source in files.items()})
    replace_text(folder / CONFIG, config_text(config))


def _own_files(config: ExperimentConfig) -> dict[str, Path]:
    """The files that a configuration leads to, by its key."""
    files = {"domain": Path(config.domain)} if config.domain.endswith(".al") else {}
    refinement = Path(config.refinement or "")
    return files | {"refinement": refinement} if refinement.is_absolute() else files


def config_text(config: ExperimentConfig) -> str:
    """The configuration as YAML: every key with its value or default, of scenarios what is set.

    Keys of scenarios are left out where there are levels.
    """
    keys = config.model_dump(mode="json", exclude=set(SCENARIO_KEYS) if config.is_fine else None)
    if config.is_fine:
        return write_yaml(keys)
    own = config.model_dump(mode="json", include={"scenario_settings"}, exclude_none=True)
    return write_yaml(keys | own)


def check_unchanged(folder: Path, config: ExperimentConfig) -> None:
    """Raise StoreError, showing the difference, unless `config` is the one stored in `folder`.

    Of a long difference the beginning is shown: the keys that were given, then defaults.
    """
    try:
        stored = flat_config(read_config(folder))
    except ConfigError as error:
        raise StoreError(str(error)) from None
    given = flat_config(config)
    changed = [
        key
        for key in dict.fromkeys((*stored, *given))
        if stored.get(key) != given.get(key) and key not in ANY_RESULT
    ]
    if changed:
        head = f"{folder}: its configuration is another one; resume it unchanged or choose --out"
        changed.sort(key=lambda key: key.partition(".")[0] not in config.model_fields_set)
        raise StoreError("\n".join([head, *_told(changed, stored, given)]))


def _told(
    changed: Sequence[str], stored: Mapping[str, object], given: Mapping[str, object]
) -> Iterator[str]:
    for key in changed[:MOST_CHANGES]:
        yield f"  {key}: {stored.get(key, 'absent')} -> {given.get(key, 'absent')}"
    if len(changed) > MOST_CHANGES:
        yield f"  and {len(changed) - MOST_CHANGES} more"


def flat_config(config: ExperimentConfig) -> dict[str, object]:
    """The keys that are set, nested ones with dots, and the texts of its own files."""
    flat: dict[str, object] = {}

    def walk(prefix: str, value: object) -> None:
        if isinstance(value, dict):
            for key, item in value.items():
                walk(f"{prefix}{key}.", item)
        else:
            flat[prefix.removesuffix(".")] = value

    walk("", config.model_dump(mode="json", exclude_none=True))
    for key, file in _own_files(config).items():
        flat[key] = file.name
        flat[key + TEXT] = file.read_text(encoding="utf-8")
    return flat
