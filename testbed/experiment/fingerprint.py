"""What the results of a process rest on: versions of libraries, and sources.

Processes that play the trials of one run have to be alike in it. It is taken once in a process, the
code of which stays as it was when its files change.
"""

import hashlib
import importlib.metadata
import platform
from collections.abc import Iterable, Mapping
from functools import cache
from importlib.util import find_spec
from pathlib import Path

from testbed.registry import OURS

LIBRARIES = (
    *("clingo", "eclipse-zenoh", "pettingzoo", "gymnasium", "msgspec", "numpy", "pydantic"),
    "scipy",  # the oracle's bounds are linear programs
)
PACKAGES = ("agents", "asp", "testbed")
"""The packages of this distribution."""
SOURCES = (".py", ".lp", ".al", ".fine", ".lark")
MISSING = "not installed"


def versions() -> dict[str, str]:
    """Versions of Python, of this distribution and of the libraries that results rest on."""
    found = {"python": platform.python_version()}
    for name in (OURS, *LIBRARIES):
        try:
            found[name] = importlib.metadata.version(name)
        except importlib.metadata.PackageNotFoundError:
            found[name] = MISSING
    return found


def fingerprint(others: Iterable[str] = ()) -> dict[str, str]:
    """The versions, and hashes of the sources of our packages and of `others`, by name."""
    packages = (*PACKAGES, *others)
    return {**versions(), **{f"source of {name}": source_hash(name) for name in packages}}


@cache
def source_hash(package: str) -> str:
    """A hash of the sources of a package, or module, wherever it is installed."""
    spec = find_spec(package)
    if spec is None:
        return MISSING
    digest = hashlib.blake2b(digest_size=6)
    for folder in map(Path, spec.submodule_search_locations or ()):
        files = (file for file in folder.rglob("*") if file.suffix in SOURCES)
        for name, file in sorted((file.relative_to(folder).as_posix(), file) for file in files):
            digest.update(f"{name}\0{file.stat().st_size}\0".encode() + file.read_bytes())
    if not spec.submodule_search_locations and spec.origin and Path(spec.origin).is_file():
        digest.update(Path(spec.origin).read_bytes())
    return digest.hexdigest()


def difference(wanted: Mapping[str, str]) -> str | None:
    """In what this process differs from a fingerprint, in one line; None where it is alike."""
    others = [name.removeprefix("source of ") for name in wanted if name.startswith("source of ")]
    own = fingerprint(name for name in others if name not in PACKAGES)
    unlike = (
        f"{name} {own.get(name, MISSING)}, not {of}"
        for name, of in wanted.items()
        if own.get(name) != of
    )
    return "; ".join(unlike) or None
