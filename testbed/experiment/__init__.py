"""Experiments: a configuration becomes trials, which are played and recorded in a run folder."""

from typing import TYPE_CHECKING, Any

from testbed.experiment.errors import StoreError as StoreError
from testbed.experiment.errors import WorkerError as WorkerError

if TYPE_CHECKING:
    from testbed.experiment.runner import run as run
    from testbed.experiment.status import RunStatus as RunStatus


def __getattr__(name: str) -> Any:
    """`run`, and what it returns, when asked for: what plays trials takes seconds to import."""
    if name in ("RunStatus", "run"):
        from testbed.experiment import runner  # noqa: PLC0415

        return getattr(runner, name)
    raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
