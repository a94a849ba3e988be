"""Intention Testbed: reasoning robots in a world that others change."""

from importlib.metadata import version as _version_of


def __getattr__(name: str) -> str:
    """`__version__`: that of the installed distribution, looked up when it is asked for."""
    if name == "__version__":
        return _version_of("intention-testbed")
    raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
