"""What can be wrong with what the environment is asked."""


class StateError(ValueError):
    """Literals that describe no state of the domain; one line says why."""


class UnknownActionError(ValueError):
    """The name of an action that the description does not declare."""


class NotExecutableError(ValueError):
    """A compound action without a successor in the state; one line says why."""


class IllegalActionError(ValueError):
    """An agent's answer outside its mask; the environment's state is unchanged."""
