"""The interface of heeding: which visible literals enter the history (P 3.2)."""

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from typing import Protocol

from asp.language import Action, Literal
from asp.solving import State


@dataclass(frozen=True)
class Scene:
    """What a robot sees at a step, and what it had in mind when it came there.

    `believed` is the state that it believed before. `action` is the action at hand: the attempt of
    the step before, or, where this was a mental action, the next one of the activity in progress;
    None where there is neither. `rest` are the actions of that activity that are still ahead.
    """

    visible: Sequence[Literal]
    believed: State
    action: Action | None
    rest: tuple[Action, ...]


class Heeding(Protocol):
    """Chooses what a robot heeds while it pursues one goal in one domain."""

    def heeded(self, scene: Scene, /) -> Iterable[Literal]:
        """The visible literals that are heeded, beside the outcome of the last attempt.

        Raises LimitError.
        """
