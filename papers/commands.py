"""What to give `testbed run` to make a run again, as the pages of a run print it."""

import json
from pathlib import Path

import testbed
from testbed.config import ExperimentConfig, load_config
from testbed.experiment.run_folder import OWN_FILES, PROVENANCE, TEXT, flat_config

EXAMPLES = "examples"
"""Where the domains are that the pages of this repository are about, and that are not packaged."""
ROOT = Path(testbed.__file__).resolve().parent.parent


def place(config: ExperimentConfig) -> str:
    """The folder in which `testbed run` puts a run."""
    return f"runs/{config.name}"


def arguments(config: ExperimentConfig, packaged: str) -> list[str]:
    """The packaged configuration, and what differs from it, not quoted for a shell.

    A domain or map of one's own is named where the run has its copy.
    """
    start, own = flat_config(load_config(packaged)), flat_config(config)
    for key in OWN_FILES:
        text = own.pop(key + TEXT, None)
        if text is not None:
            own[key] = _file(config, str(own[key]), str(text))
    # What only the packaged one sets must be unset.
    unset = {key: None for key in start if key not in own}
    changed = {key: value for key, value in own.items() if start.get(key) != value}
    return [packaged, *(f"{key}={_value(value)}" for key, value in (changed | unset).items())]


def _file(config: ExperimentConfig, name: str, text: str) -> str:
    example = ROOT / EXAMPLES / name
    if example.is_file() and example.read_text(encoding="utf-8") == text:
        return f"{EXAMPLES}/{name}"
    return f"{place(config)}/{name}"


def _value(value: object) -> str:
    """As YAML reads it."""
    if isinstance(value, list | tuple):
        return "[" + ",".join(map(_value, value)) + "]"
    return json.dumps(value) if value is None or isinstance(value, bool) else str(value)


def workers_of(folder: Path) -> int | None:
    """How many processes played the last session of a run; None where it is not on record."""
    path = folder / PROVENANCE
    kept = json.loads(path.read_text(encoding="utf-8")) if path.is_file() else {}
    workers = kept.get("workers")
    return workers if isinstance(workers, int) else None
