"""Where a run came from: versions, platform, command, revision, start and end."""

import json
import os
import platform
from collections.abc import Sequence
from datetime import UTC, datetime
from pathlib import Path
from typing import Any

import msgspec

import asp
from asp.refinement import read_refinement
from testbed.config import ExperimentConfig
from testbed.experiment.fingerprint import versions
from testbed.experiment.origin import ROOT, git
from testbed.experiment.run_folder import PROVENANCE, replace_text
from testbed.experiment.shard import Shard
from testbed.experiment.texts import sha256
from testbed.registry import PATH_VARIABLE

DIFFERENCE = "difference.patch"


class Provenance:
    """The provenance of one session of a run; those of earlier sessions are kept under `before`."""

    def __init__(
        self,
        folder: Path,
        config: ExperimentConfig,
        command: Sequence[str],
        before: Sequence[dict[str, Any]] | None = None,
        shard: Shard | None = None,
    ) -> None:
        self._folder, description = folder, asp.load_description(config.domain)
        own = config.refinement
        self._entry: dict[str, Any] = {
            "command": list(command),
            "shard": None if shard is None else str(shard),
            "start": _now(),
            **dict.fromkeys(("end", "exit", "workers")),
            "versions": versions(),
            "platform": {"system": platform.platform(), "machine": platform.machine()},
            "revision": revision(folder),
            "domain": _text(description.name, description.source),
            "refinement": own and _text(Path(own).stem, read_refinement(own)[1]),
            "modules": os.environ.get(PATH_VARIABLE) or None,
            "before": sessions_of(folder) if before is None else before,
        }
        self._write()

    def close(self, code: int, workers: int | None) -> None:
        """Record the end of the session, its exit code and how many processes played, if known."""
        self._entry |= {"end": _now(), "exit": code, "workers": workers}
        self._write()

    def _write(self) -> None:
        replace_text(self._folder / PROVENANCE, json.dumps(self._entry, indent=2) + "\n")


def modules_of(folder: Path) -> Path | None:
    """The folder that was searched for modules of a run's own; None where that is not known."""
    sessions = sessions_of(folder)
    found = next((own["modules"] for own in reversed(sessions) if own.get("modules")), None)
    return Path(found) if isinstance(found, str) else None


def revision(folder: Path, root: Path = ROOT) -> dict[str, object] | None:
    """The git revision of the checkout this package runs from; None when installed.

    What differs in tracked files is written to `difference.patch` in `folder`, if anything does.
    """
    if not (root / ".git").exists():
        return None
    commit, changed = git(root, "rev-parse", "HEAD"), git(root, "status", "--porcelain")
    if commit is None or changed is None:
        return None
    if difference := git(root, "diff", "HEAD"):
        replace_text(folder / DIFFERENCE, difference + "\n")
    return {"commit": commit, "changed": changed.splitlines()}


def _text(name: str, text: str) -> dict[str, str]:
    return {"name": name, "sha256": sha256(text)}


def sessions_of(folder: Path) -> list[dict[str, Any]]:
    """The sessions of a run, as far as they are known, the last one last."""
    last = read_provenance(folder)
    return [*last.pop("before", []), last] if last else []


def read_provenance(folder: Path) -> dict[str, Any]:
    """What `provenance.json` holds; empty where it is not what a run writes there."""
    try:
        return msgspec.json.decode((folder / PROVENANCE).read_bytes(), type=dict[str, Any])
    except (OSError, msgspec.DecodeError, UnicodeDecodeError, RecursionError):
        return {}


def _now() -> str:
    return datetime.now(UTC).isoformat(timespec="seconds")
