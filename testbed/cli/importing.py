"""Whether the packages that are imported are ours, whatever the working directory holds.

A process that `testbed` starts imports nothing from there (`-P`).
"""

import importlib.metadata
from importlib.util import find_spec
from pathlib import Path

DISTRIBUTION = "intention-testbed"


def displaced() -> str | None:
    """One line about a package of ours in whose place another one is found; None if there is none.

    That the file lies beside ours is not enough: another distribution may have overwritten it.
    """
    for name in ("asp", "agents"):
        found = find_spec(name)
        file = Path(found.origin) if found and found.origin else None
        if file is None or not _is_ours(file, name):
            where = f"{file or name}: not the package '{name}' of {DISTRIBUTION}{_owner(name)}"
            return f"{where}; start `testbed` (or `python -P -m testbed`) where that is not found"
    return None


def _is_ours(file: Path, name: str) -> bool:
    where_it_should_be = Path(__file__).resolve().parents[2] / name / "__init__.py"
    return file.resolve() == where_it_should_be and f'"{DISTRIBUTION}"' in file.read_text("utf-8")


def _owner(name: str) -> str:
    owners = importlib.metadata.packages_distributions().get(name, [])
    others = sorted({owner for owner in owners if owner != DISTRIBUTION})
    return f", but of {', '.join(others)}" if others else ""
