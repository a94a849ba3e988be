"""Intention Testbed: reasoning robots in a world that others change."""

from importlib.metadata import version as _version_of
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from testbed.analysis import load_run

__all__ = ["load_run"]


def __getattr__(name: str) -> Any:
    """`load_run`, and the installed `__version__`, each looked up when it is asked for."""
    if name == "__version__":
        return _version_of("intention-testbed")
    if name == "load_run":
        from testbed.analysis import load_run  # noqa: PLC0415  # few need polars

        return load_run
    raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
