"""What a decision came to, before it is told and recorded."""

from collections.abc import Mapping
from dataclasses import dataclass, field

from msgspec import structs

from agents.shared.reasoning import Intention
from asp.reasoning.diagnosis import Diagnosis, Explanation, Happening
from asp.solving import Reading, State, reasoning_clock
from testbed.protocol import Minimality, Trace


@dataclass
class Thought:
    """What the two phases at a step came to, as far as they did, and when they were over.

    `before` is what explained the history before; `outcome` is an action whose outcome was another
    one than expected, if that is new, and `expected` are the states that were expected, by step,
    where actions may have several outcomes; `is_new` says whether the plan was made now;
    `limit` names the limit of decisions that was reached, if any. A phase that the time for the
    decision did not suffice for ended when the decision did.
    """

    before: Explanation
    diagnosis: Diagnosis | None = None
    intention: Intention | None = None
    outcome: Happening | None = None
    expected: Mapping[int, State] = field(default_factory=dict)
    is_new: bool = True
    limit: str = ""
    began: Reading = field(default_factory=reasoning_clock)
    diagnosed: Reading | None = None
    ended: Reading = field(default_factory=Reading)

    @property
    def minimal(self) -> Minimality:
        """Whether what explains the history is proved to be as small as any.

        Where the first phase did not end, that is not even known to explain it.
        """
        found = self.diagnosis
        return "proved" if found is not None and found.explanation.proved else "unproved"

    def timed(self, trace: Trace, prepared: float) -> Trace:
        """The trace with the times of both phases.

        With the preparation since the decision began goes what was `prepared` before it, in seconds
        of process time.
        """
        diagnosed = self.diagnosed or self.ended
        diagnosis, planning = diagnosed.since(self.began), self.ended.since(diagnosed)
        return structs.replace(
            trace,
            planning_time_s=planning.wall,
            diagnosis_time_s=diagnosis.wall,
            planning_cpu_s=planning.cpu,
            diagnosis_cpu_s=diagnosis.cpu,
            preparation_cpu_s=prepared + reasoning_clock().since(self.began).preparation_cpu,
        )
