"""A reasoner that reasons in two ways, from scratch and incrementally, and holds them equal."""

from dataclasses import dataclass, replace
from typing import Generic
from unittest.mock import patch

import pytest

from agents.shared import Intention, MakeReasoner, Reasoner
from asp.reasoning import Goal, Knowledge
from asp.reasoning.diagnosis import (
    Compression,
    Diagnosis,
    Explanation,
    H_contra,
    InconsistentHistoryError,
    incremental,
)
from testbed.protocol import Plans

USUAL = Compression()
EARLY = Compression(after=4, answers=400)
"""The history is compressed after a few steps already."""


@dataclass(frozen=True)
class Both(Generic[H_contra]):
    """Reasons in both ways, and insists that they agree; also where nothing explains the history.

    Where actions have several outcomes, which index an activity has may depend on them: there the
    diagnosis in which the intention believes has to agree, and not that of phase one.
    """

    incremental: Reasoner[H_contra]
    reference: Reasoner[H_contra]
    deterministic: bool

    def diagnose(self, history: H_contra, adopted: Explanation, /) -> Diagnosis:
        ours, theirs = self._diagnosed(history, adopted)
        if self.deterministic:
            assert ours == theirs
        assert ours.explanation == theirs.explanation
        assert ours.indices.keys() == theirs.indices.keys()
        return ours

    def intend(self, history: H_contra, diagnosis: Diagnosis, /) -> Intention:
        ours = self.incremental.intend(history, diagnosis)
        theirs = self.reference.intend(history, diagnosis)
        if self.deterministic:
            assert ours == theirs
        assert replace(ours, under=None) == replace(theirs, under=None)
        assert (ours.under or diagnosis) == (theirs.under or diagnosis)
        return ours

    def _diagnosed(self, history: H_contra, adopted: Explanation) -> tuple[Diagnosis, Diagnosis]:
        try:
            ours = self.incremental.diagnose(history, adopted)
        except InconsistentHistoryError:
            with pytest.raises(InconsistentHistoryError):
                self.reference.diagnose(history, adopted)
            raise
        try:
            return ours, self.reference.diagnose(history, adopted)
        except InconsistentHistoryError as error:
            raise AssertionError(
                f"only the incremental way explains the history: {error}"
            ) from error


def both_ways(
    incrementally: MakeReasoner[H_contra],
    from_scratch: MakeReasoner[H_contra],
    compression: Compression = USUAL,
) -> MakeReasoner[H_contra]:
    """Makes reasoners of both ways; histories are compressed so by the incremental one."""

    def make(
        knowledge: Knowledge, goal: Goal, plan_limit: int, plans: Plans = "optimistic"
    ) -> Both[H_contra]:
        with patch.object(incremental, "COMPRESSION", compression):
            ours = incrementally(knowledge, goal, plan_limit, plans)
        theirs = from_scratch(knowledge, goal, plan_limit, plans)
        return Both(ours, theirs, knowledge.deterministic)

    return make
