"""What the phases of a decision take: diagnosis, then planning; and what was prepared for them."""

from __future__ import annotations

from dataclasses import dataclass, field

from msgspec import structs

from asp.solving import Reading, reasoning_clock
from testbed.protocol import Trace


@dataclass
class Phases:
    """Readings of the clock in one decision, which begins with diagnosis.

    A phase that the time for the decision did not suffice for has none.
    """

    began: Reading = field(default_factory=reasoning_clock)
    diagnosed: Reading | None = None
    ended: Reading | None = None

    def diagnosis_is_over(self) -> None:
        """From now on it is planning."""
        self.diagnosed = reasoning_clock()

    def end(self) -> None:
        """What follows is no reasoning."""
        self.ended = reasoning_clock()

    def timed(self, trace: Trace, prepared: float) -> Trace:
        """The trace with the times of both phases.

        With the preparation since the decision began goes what was `prepared` before it, in seconds
        of process time.
        """
        diagnosis, planning = self._diagnosis, self._planning
        since = reasoning_clock().since(self.began)
        return structs.replace(
            trace,
            planning_time_s=planning.wall,
            diagnosis_time_s=diagnosis.wall,
            planning_cpu_s=planning.cpu,
            diagnosis_cpu_s=diagnosis.cpu,
            preparation_cpu_s=prepared + since.preparation_cpu,
        )

    @property
    def _diagnosis(self) -> Reading:
        over = self.diagnosed or self.ended
        return Reading() if over is None else over.since(self.began)

    @property
    def _planning(self) -> Reading:
        if self.diagnosed is None or self.ended is None:
            return Reading()
        return self.ended.since(self.diagnosed)
