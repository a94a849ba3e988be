"""An adversary that undoes what the robot did last."""

from collections.abc import Sequence

from agents.adversary.base import AdversaryView
from agents.adversary.choosing import Choosing
from agents.adversary.lookahead import bits_in_all, bits_in_any


class Meddler(Choosing):
    """Restores as many as possible of the literals that the robot's last action changed.

    That is the last action that changed anything. Literals that the robot's present action restores
    by itself do not count.
    """

    def reset(self, seed: int) -> None:
        """The robot has not done anything yet."""
        super().reset(seed)
        self._last: tuple[int, AdversaryView] | None = None
        self._changed = self._values = 0

    def _watch(self, state: int, view: AdversaryView) -> None:
        """What the action of the step before changed, and what had been there."""
        if self._last is not None:
            before, then = self._last
            own = (before ^ after for after in self._ahead.after(before, then))
            changed = (before ^ state) & bits_in_any(own)
            if changed:
                self._changed, self._values = changed, before & changed
        self._last = state, view

    def _worth(self, outcome: int, alone: Sequence[int]) -> tuple[float, ...]:
        lacking = self._changed & bits_in_all(each ^ self._values for each in alone)
        restored = lacking & ~(outcome ^ self._values)
        return (restored.bit_count(),) if restored else ()
