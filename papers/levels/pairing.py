"""Pairs of trials at a level, with zooming and without: what each robot met, and what it did."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass
from typing import Literal

from testbed.experiment.record import TrialRecord
from testbed.studies import joined
from testbed.studies.levels.load import FineOutline, fine_outline
from testbed.studies.levels.published import NO_ZOOM, ZOOM

Meeting = Literal["nothing", "same", "longer", "other"]
MEETINGS: Mapping[Meeting, str] = {
    "nothing": "nothing exogenous happened to either robot",
    "same": "the same exogenous actions, each at the same step of the robot",
    "longer": "the same, and more to one of them after the other's trial had ended",
    "other": "other exogenous actions, or at other steps",
}


@dataclass(frozen=True, slots=True)
class Trial:
    """What is kept of one robot's trial in a pair.

    `events` are the exogenous actions with the steps of the robot at which they happened; `did`
    its abstract actions with theirs; `explained` is how often it had to explain an observation.
    """

    trial: str
    outcome: str
    steps: int
    initial: tuple[str, ...]
    goal: tuple[str, ...]
    events: tuple[tuple[int, str], ...]
    did: tuple[tuple[int, str], ...]
    explained: int
    counts: FineOutline


@dataclass(frozen=True, slots=True)
class Pair:
    """Both trials of a pair, whose seed this is."""

    level: str
    seed: int
    zoom: Trial
    no_zoom: Trial

    @property
    def achieved(self) -> bool:
        """Whether both robots achieved the goal."""
        return self.zoom.counts.achieved and self.no_zoom.counts.achieved

    @property
    def meeting(self) -> Meeting:
        """Whether the robots met the same exogenous actions."""
        short, long = sorted((self.zoom, self.no_zoom), key=lambda trial: trial.steps)
        if not short.events and not long.events:
            return "nothing"
        if short.events == long.events:
            return "same"
        met = tuple(event for event in long.events if event[0] <= short.steps)
        return "longer" if met == short.events else "other"

    @property
    def alike(self) -> bool:
        """Whether both did the same: as many refined plans, concrete actions and tests for it."""
        return _work(self.zoom) == _work(self.no_zoom)


def _work(trial: Trial) -> tuple[object, ...]:
    own = trial.counts
    return trial.steps, trial.did, own.plans, own.actions, own.tests


def pairs_of(records: Iterable[TrialRecord]) -> Iterator[Pair]:
    """The pairs of the two conditions, as they become complete; others' records are passed over."""
    for zoom, no_zoom in joined((own for own in records if own.fine), (ZOOM, NO_ZOOM)):
        yield Pair(zoom.level, zoom.seed, _trial(zoom), _trial(no_zoom))


def _trial(record: TrialRecord) -> Trial:
    assert record.fine is not None
    return Trial(
        trial=record.trial,
        outcome=record.outcome,
        steps=record.steps,
        initial=tuple(record.initial),
        goal=tuple(record.goal),
        events=tuple((event.step, event.action) for event in record.exogenous),
        did=tuple((attempt.step, attempt.action) for attempt in record.actions),
        explained=len(record.explanations),
        counts=fine_outline(record, record.fine),
    )
