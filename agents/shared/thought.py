"""What a robot thinks at a step: an explanation in phase one, an intention in phase two."""

from dataclasses import dataclass, field
from typing import Protocol

from msgspec import structs

from asp.language import Action, Fluent
from asp.reasoning.diagnosis import Diagnoser, Diagnosis, Explanation, H_contra
from asp.solving import Reading, reasoning_clock
from testbed.protocol import Trace


@dataclass(frozen=True)
class Intention:
    """What the agent intends at a step, the plan it would start with it, and what it believes.

    Where the goal holds, or the plan that led to it is over, `GOAL` is among what is `believed`.
    `under` is the diagnosis that it believes in, where this is chosen with the intention.
    """

    action: Action
    plan: tuple[Action, ...]
    believed: frozenset[Fluent]
    under: Diagnosis | None = None


class Reasoner(Diagnoser[H_contra], Protocol[H_contra]):
    """The two phases of reasoning about one goal, from scratch or incrementally."""

    def intend(self, history: H_contra, diagnosis: Diagnosis, /) -> Intention:
        """Phase two. Raises LimitError."""


@dataclass
class Thought:
    """What the two phases at a step came to, as far as they did, and when they were over.

    `before` is what explained the history before; `is_new` says whether the plan was made now;
    `limit` names the limit of decisions that was reached, if any. A phase that the time for the
    decision did not suffice for ended when the decision did.
    """

    before: Explanation
    diagnosis: Diagnosis | None = None
    intention: Intention | None = None
    is_new: bool = True
    limit: str = ""
    began: Reading = field(default_factory=reasoning_clock)
    diagnosed: Reading | None = None
    ended: Reading = field(default_factory=Reading)

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
