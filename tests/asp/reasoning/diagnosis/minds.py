"""Diagnosers with a compressed past and with the whole history, whose answers are compared."""

import copy
from unittest.mock import patch

from agents.shared import sessions_of
from asp.reasoning import Goal, knowledge
from asp.reasoning.diagnosis import (
    Compression,
    Diagnosis,
    DiagnosisSessions,
    Explanation,
    History,
    IncrementalDiagnoser,
    incremental,
)
from tests.agents.intentional.lives import Place
from tests.asp.reasoning.diagnosis.wandering import Habits, wander

WHOLE = None
TINY = Compression(after=4, answers=400, late=8)


class Unused:
    """A reference that is never asked."""

    def diagnose(self, history: History, _adopted: Explanation, /) -> Diagnosis:
        raise AssertionError(f"more events than are counted at step {history.step}")


class Mind:
    """A diagnoser, and what it has adopted."""

    def __init__(
        self,
        where: Place,
        compression: Compression | None,
        goal: Goal,
        sessions: DiagnosisSessions | None = None,
        since: int = 1,
    ) -> None:
        """`since` is the first step at which events may have occurred."""
        sessions = sessions or sessions_of(knowledge(where.domain, where.source)).diagnosis
        with patch.object(incremental, "COMPRESSION", compression):
            self.diagnoser = IncrementalDiagnoser(sessions, goal, since, Unused())
        self.adopted = Explanation()

    def think(self, history: History) -> tuple[object, ...]:
        """The explanation, the state, when the goal held."""
        self.diagnosis = self.diagnoser.diagnose(history, self.adopted)
        self.adopted, belief = self.diagnosis.explanation, self.diagnoser.belief
        return self.adopted, belief.step, belief.state, belief.held

    @property
    def others(self) -> tuple[list[Explanation], bool]:
        assert self.diagnosis.alternatives is not None
        return self.diagnosis.alternatives(20)

    @property
    def compressed(self) -> int:
        """The step up to which its history is compressed."""
        known = self.diagnoser.frontier
        return known.step if known else 0


def compare(
    where: Place, goal: Goal, steps: int, seed: int, habits: Habits, compression: Compression
) -> int:
    """How often something was explained anew with a compressed past, equal each time."""
    compressed, whole = Mind(where, compression, goal), Mind(where, WHOLE, goal)
    explained = 0
    for history in wander(where, goal, steps, seed, habits):
        before = whole.adopted
        theirs = whole.think(copy.deepcopy(history))
        assert compressed.think(history) == theirs, history.step
        if whole.adopted != before:
            explained += compressed.compressed > 0
            compare_others(compressed.others, whole.others, whole.adopted)
    return explained


def compare_others(
    compressed: tuple[list[Explanation], bool],
    whole: tuple[list[Explanation], bool],
    adopted: Explanation,
) -> None:
    """All explanations of the size are told, or that there are more."""
    (some, more), (every, too_many) = compressed, whole
    assert len(set(some)) == len(some)
    assert all(a.size == adopted.size for a in some)
    if not too_many:
        assert set(some) <= set(every)
        assert more or len(some) == len(every)
