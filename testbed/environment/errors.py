"""What can be wrong with what the environment is asked."""


class IllegalActionError(ValueError):
    """An agent's answer outside its mask; the environment's state is unchanged."""


class UnknownAgentError(ValueError):
    """The name of an agent that is not one of the environment's; one line names these."""


class UnknownOptionError(ValueError):
    """A key of `reset(options=...)` that means nothing; one line says which is likely meant."""


class NotResetError(AssertionError):
    """Something was asked of a game before `reset`; PettingZoo's wrapper raises the same kind."""

    def __init__(self) -> None:
        super().__init__("no game has begun: reset the environment first")
