"""Statistics of the trials of a run, which `load_run` reads into one table."""

from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from testbed.analysis.run import Run, load_run

__all__ = ["Run", "load_run"]


def __getattr__(name: str) -> Any:
    """Names are looked up when they are asked for: polars takes a while to load."""
    if name in __all__:
        from testbed.analysis import run  # noqa: PLC0415

        return getattr(run, name)
    raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
