"""Experiments: a configuration becomes trials, which are played and recorded in a run folder.

The names of this package are imported when they are first asked for, since what plays trials takes
seconds to import and most commands need a part of it.
"""

from importlib import import_module
from typing import TYPE_CHECKING

__all__ = [
    "RunStatus",
    "StoreError",
    "TrialRecord",
    "WorkerError",
    "plan_trials",
    "play_trial",
    "read_config",
    "read_records",
    "run",
]

if TYPE_CHECKING:
    from testbed.experiment.errors import StoreError, WorkerError
    from testbed.experiment.plan import plan_trials
    from testbed.experiment.record import TrialRecord
    from testbed.experiment.run_folder import read_config
    from testbed.experiment.runner import RunStatus, run
    from testbed.experiment.store import read_records
    from testbed.experiment.trial import play_trial
else:
    _PLACES = {
        "RunStatus": "runner",
        "StoreError": "errors",
        "TrialRecord": "record",
        "WorkerError": "errors",
        "plan_trials": "plan",
        "play_trial": "trial",
        "read_config": "run_folder",
        "read_records": "store",
        "run": "runner",
    }

    def __getattr__(name):
        if name in _PLACES:
            return getattr(import_module(f"{__name__}.{_PLACES[name]}"), name)
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
