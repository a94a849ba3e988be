"""Lives of a robot against a besieger: its decisions are timed, what it explains is asked again."""

import pickle
import time
from collections.abc import Iterator
from dataclasses import dataclass, field
from typing import NamedTuple

from agents.intentional import IntentionalRobot
from agents.intentional.activities import History
from agents.intentional.reasoners import IncrementalReasoner, ReferenceReasoner
from agents.shared import Intention
from asp.language import Literal
from asp.reasoning import Knowledge
from asp.reasoning.diagnosis import Diagnosis, Explanation
from asp.solving import LimitError, Limits, deciding
from testbed.experiment.specs import TrialSpec
from testbed.experiment.trial import play_trial
from testbed.link import InProcessRobot
from testbed.protocol import Decision, Percept, Plans, Task

REFERENCE = Limits(conflicts=4_000)
"""Of the reference per question; half of it is for the proof. Its time is not limited, so that what
ends does not depend on the machine."""
GIVEN_UP = 2
"""After so many questions of a game that did not end the reference is asked no more of it."""


@dataclass(frozen=True)
class Moment:
    """A decision: its process time (ms), that of grounding in it, and the size of what it assumes.

    `adopted`: it adopted an explanation; `cut`: its budget was used up.
    """

    step: int
    ms: float
    grounding_ms: float
    size: int
    adopted: bool
    cut: bool


@dataclass
class Life:
    """The decisions of a game; what was explained anew in it, and the reference to ask that again.

    Each question is a history, what was adopted before, and what was found. They are pickled, for
    the garbage collector would look through them within decisions.
    """

    moments: list[Moment] = field(default_factory=list)
    questions: list[bytes] = field(default_factory=list)
    reference: ReferenceReasoner | None = None


class Watched:
    """An intentional robot with a clock, whose questions are kept up to a step."""

    def __init__(self, life: Life, last_asked: int) -> None:
        self._life = life
        self._last_asked = last_asked
        self._explanation = Explanation()
        self._robot = IntentionalRobot(self._reasoner)
        self._keeping_ms = 0.0

    def begin(self, task: Task) -> None:
        self._robot.begin(task)

    def act(self, percept: Percept) -> Decision:
        self._keeping_ms = 0.0
        began = time.process_time()
        decision = self._robot.act(percept)
        ms = (time.process_time() - began) * 1e3 - self._keeping_ms
        trace, held = decision.trace, self._explanation
        cut = trace.intention is None or not held.proved
        grounding = trace.preparation_cpu_s * 1e3
        adopted = trace.explanation is not None
        self._life.moments.append(Moment(percept.step, ms, grounding, held.size, adopted, cut))
        return decision

    def _reasoner(
        self, knowledge: Knowledge, goal: tuple[Literal, ...], limit: int, plans: Plans
    ) -> "Watched":
        self._fast = IncrementalReasoner(knowledge, goal, limit, plans)
        self._life.reference = ReferenceReasoner(knowledge, goal, limit, plans)
        return self

    def diagnose(self, history: History, adopted: Explanation) -> Diagnosis:
        found = self._fast.diagnose(history, adopted)
        self._explanation = found.explanation
        if found.explanation != adopted.left(history) and history.step <= self._last_asked:
            began = time.process_time()
            self._life.questions.append(pickle.dumps((history, adopted, found.explanation)))
            self._keeping_ms = (time.process_time() - began) * 1e3
        return found

    def intend(self, history: History, explained: Diagnosis) -> Intention:
        return self._fast.intend(history, explained)


def play(spec: TrialSpec, last_asked: int = 0) -> Life:
    """The life of a robot in a game; questions are kept of the steps up to `last_asked`.

    Raises RuntimeError if the trial failed.
    """
    life = Life()
    result = play_trial(spec, InProcessRobot(lambda _: Watched(life, last_asked)))
    if result.details is not None or result.record.outcome == "error":
        raise RuntimeError(result.details or result.record.reason)
    return life


class Verdict(NamedTuple):
    """Of a question: whether the reference proved a smallest explanation, and found the same."""

    ended: bool
    equal: bool


def verdicts(life: Life) -> Iterator[Verdict]:
    """The questions of a life, as they came, until the reference did not end `GIVEN_UP` times."""
    left = GIVEN_UP
    for packed in life.questions:
        history, adopted, ours = pickle.loads(packed)
        theirs = _by_reference(life, history, adopted)
        yield Verdict(theirs is not None, theirs == ours)
        left -= theirs is None
        if not left:
            return


def _by_reference(life: Life, history: History, adopted: Explanation) -> Explanation | None:
    """What the reference proves to be a smallest explanation; None where it does not end."""
    assert life.reference is not None, "a life begins with a task"
    try:
        with deciding(REFERENCE):
            found = life.reference.diagnose(history, adopted).explanation
    except LimitError:
        return None
    return found if found.proved else None
