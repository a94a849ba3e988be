"""Errors of a user about an experiment, apart from its configuration."""


class StoreError(ValueError):
    """A run folder that cannot be used as asked: one line or more that say why."""


class WorkerError(RuntimeError):
    """No trial can be played, for a process that is to play them does not start: one line."""
