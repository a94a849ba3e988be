"""Where a record came from: versions, machine, load, revision, and hashes of what was read."""

import os
import platform
import subprocess
from functools import cache
from pathlib import Path

import msgspec

from testbed.experiment.fingerprint import versions
from testbed.protocol import Count

CPUS = Path("/proc/cpuinfo")
ROOT = Path(__file__).resolve().parents[2]


class Origin(msgspec.Struct, kw_only=True):
    """Where a record came from; no result is part of it.

    `versions` are those of the process that played, `cores` what it may use, `load` the processes
    of the machine that wanted to run, as the mean of the minute before the trial's end. `revision`
    and `dirty` are None where the package is installed without its repository. The hashes are
    SHA-256: of the resolved configuration, as `config.yaml` has it, None for a trial of no run, and
    of the descriptions, None where the trial failed before they were read.
    """

    versions: dict[str, str]
    cpu: str
    cores: Count
    load: float | None = None
    revision: str | None = None
    dirty: bool | None = None
    config_sha256: str | None = None
    domain_sha256: str | None = None
    refinement_sha256: str | None = None


def here() -> Origin:
    """What is the same for all trials of this process, to be completed for one of them."""
    return msgspec.structs.replace(_of_process())


@cache
def _of_process() -> Origin:
    revision, dirty = checked_out(ROOT)
    return Origin(versions=versions(), cpu=_cpu(), cores=cores(), revision=revision, dirty=dirty)


def checked_out(root: Path) -> tuple[str | None, bool | None]:
    """The git revision of a checkout, and whether a tracked file differs; None of anything else."""
    if not (root / ".git").exists():
        return None, None
    changed = git(root, "status", "--porcelain", "--untracked-files=no")
    return git(root, "rev-parse", "HEAD"), None if changed is None else bool(changed)


def git(root: Path, *arguments: str) -> str | None:
    """What git says of a checkout, where it does; it takes no lock, for others work there."""
    try:
        command = ["git", "--no-optional-locks", "-C", str(root), *arguments]
        done = subprocess.run(command, check=False, capture_output=True, text=True, timeout=20)
    except (OSError, subprocess.TimeoutExpired):
        return None
    return done.stdout.rstrip("\n") if done.returncode == 0 else None


def cores() -> int:
    """How many cores this process may use."""
    own = hasattr(os, "sched_getaffinity")  # where the system says which
    return len(os.sched_getaffinity(0)) if own else os.cpu_count() or 1


def load() -> float | None:
    """The load average of the last minute; None where the system does not say."""
    try:
        return round(os.getloadavg()[0], 2)
    except OSError:
        return None


def _cpu() -> str:
    """The model of the processor, or where that is not known its architecture."""
    lines = CPUS.read_text("utf-8", "replace").splitlines() if CPUS.is_file() else ()
    named = (line.partition(":")[2].strip() for line in lines if line.startswith("model name"))
    return next(named, "") or platform.processor() or platform.machine()
