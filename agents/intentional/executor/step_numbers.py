"""The steps of the coarse history, each of which takes one or more steps of the environment."""

from __future__ import annotations

import re
from bisect import bisect_right

from msgspec import structs

from testbed.protocol import Contradiction, Event, Explanation, Trace

_STEP = re.compile(r"(?<=\bstep )\d+")


class Calendar:
    """When each coarse step began. Step 0 is that of both, at which the goal is selected."""

    def __init__(self) -> None:
        self._began = [0]

    @property
    def step(self) -> int:
        """The present coarse step."""
        return len(self._began) - 1

    def begin(self, step: int) -> None:
        """The next coarse step begins at this step of the environment."""
        self._began.append(step)

    def coarse(self, step: int) -> int:
        """The coarse step to which a step of the environment belongs."""
        return bisect_right(self._began, step) - 1

    def own(self, step: int) -> int:
        """The step of the environment at which a coarse step began, or may begin at the soonest."""
        ahead = max(0, step - self.step)
        return self._began[step - ahead] + ahead

    def trace(self, trace: Trace) -> Trace:
        """A trace of the coarse robot with steps of the environment in it."""
        explanation = trace.explanation
        return structs.replace(
            trace,
            explanation=None if explanation is None else self._explanation(explanation),
            contradictions=[self._contradiction(each) for each in trace.contradictions],
            alternatives=[self._explanation(each) for each in trace.alternatives],
            futile_at=None if trace.futile_at is None else self.own(trace.futile_at),
            reason=_STEP.sub(lambda found: str(self.own(int(found[0]))), trace.reason),
        )

    def _explanation(self, explanation: Explanation) -> Explanation:
        return structs.replace(
            explanation,
            step=self.own(explanation.step),
            unobserved=[self._event(event) for event in explanation.unobserved],
            distrusted=[self._event(event) for event in explanation.distrusted],
        )

    def _event(self, event: Event) -> Event:
        return structs.replace(event, step=self.own(event.step))

    def _contradiction(self, contradiction: Contradiction) -> Contradiction:
        return structs.replace(contradiction, step=self.own(contradiction.step))
