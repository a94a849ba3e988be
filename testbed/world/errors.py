"""Errors about the literals and actions that a world is given."""


class StateError(ValueError):
    """Literals that describe no state of the domain; one line says why."""


class UnknownFluentError(ValueError):
    """A literal whose atom is no fluent of the description."""


class UnknownActionError(ValueError):
    """The name of an action that the description does not declare."""


class NotExecutableError(ValueError):
    """A compound action without a successor in the state; one line says why."""
