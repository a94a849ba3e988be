"""Whether the texts in a run folder are those that its trials were played in."""

import hashlib
from collections.abc import Mapping
from pathlib import Path

import msgspec

from testbed.experiment.errors import StoreError


def sha256(text: str) -> str:
    """The SHA-256 of a text, in hexadecimal."""
    return hashlib.sha256(text.encode()).hexdigest()


class _Hashes(msgspec.Struct):
    domain_sha256: str | None = None
    refinement_sha256: str | None = None


class _Played(msgspec.Struct):
    """Of a record the hashes of what its trial was played in, whatever else is damaged."""

    origin: _Hashes | None = None


def check_texts(trials: Path, files: Mapping[str, Path]) -> None:
    """Check files, by what they are, `domain` and `refinement`, against the records in `trials`.

    Raises StoreError for another text than that of the first record whose hashes are known; older
    records have none.
    """
    played = _first_played(trials) if files and trials.is_file() else _Hashes()
    for key, file in files.items():
        text = file.read_text(encoding="utf-8")
        refuse_another(key, str(file), text, getattr(played, f"{key}_sha256"), "the run")


def refuse_another(key: str, file: str, text: str, played: str | None, what: str) -> None:
    """Raise StoreError unless a text has the hash of that in which `what` was played, if known."""
    if played not in (None, sha256(text)):
        other = f"is another {key} than {what} was played in"
        raise StoreError(f"{file}: {other}, whose SHA-256 is {played}; bring that back")


def _first_played(trials: Path) -> _Hashes:
    with trials.open("rb") as file:
        for line in file:
            try:
                origin = msgspec.json.decode(line, type=_Played).origin
            except (msgspec.DecodeError, UnicodeDecodeError, RecursionError):
                continue  # who reads the records says what is wrong with it
            if origin is None or origin.domain_sha256 is not None:
                return origin or _Hashes()
    return _Hashes()
