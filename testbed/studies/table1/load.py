"""The pairs of a run: what is kept of each, and whether both robots met the same event."""

from __future__ import annotations

from collections.abc import Collection, Iterator, Mapping
from dataclasses import dataclass
from typing import Any, Literal

import polars as pl

from testbed.analysis.comparison import DIVIDED, LEAST, NO_EVENT, NOTHING_TO_DO, Apart, measured
from testbed.analysis.table import records_of
from testbed.experiment.record import Occurrence, TrialRecord
from testbed.studies.pairs import joined
from testbed.studies.table1.classify import classify, state_at
from testbed.world import World

Meeting = Literal["nothing", "same", "same later", "other", "other at once"]
MEETINGS: Mapping[Meeting, str] = {
    "nothing": "nothing exogenous happened to either",
    "same": "same event beside the same action, after the same actions",
    "same later": "same event beside the same action; before it the robots had acted differently",
    "other": "not the same event and action: before it the robots had acted differently",
    "other at once": "not the same event and action, although the robots had acted alike",
}


@dataclass(frozen=True, slots=True)
class Side:
    """What is kept of one robot's trial in a pair.

    `decided`: whether it is known if it was correct.
    `before` are its actions up to the one that `event` goes with, or all where there is no event;
    `undone`: whether the event took away a part of the goal that would have been true; `ended`:
    whether the trial came to its end without an error.
    """

    trial: str
    lost: bool
    achieved: bool
    correct: bool
    out_of_reach: bool
    outcome: str
    event: str | None
    undone: bool
    before: tuple[str, ...]
    measures: Mapping[str, float]
    late: bool = False
    decided: bool = True
    ended: bool = True


@dataclass(frozen=True, slots=True)
class Pair:
    """Both robots' trials; `happened` is the scenario read off the intentional robot's trial.

    `state` names the initial state. `minimal` has the least that achieves the goal from there, by
    the names of measures; nothing where it was not computed.
    """

    intended: str
    happened: str
    solvable: bool
    mind: Side
    base: Side
    state: str
    minimal: Mapping[str, int]

    @property
    def played(self) -> bool:
        """Whether both trials say something of their robots, and some plan achieves the goal."""
        return self.solvable and not self.lost and not self.late

    @property
    def decided(self) -> bool:
        """Whether it is known of both trials if they were correct."""
        return self.mind.decided and self.base.decided

    @property
    def ended(self) -> bool:
        """Whether no robot's own error ended its trial: the measures are of whole trials."""
        return self.mind.ended and self.base.ended

    @property
    def lost(self) -> bool:
        """Whether something other than its robot ended one of the trials."""
        return self.mind.lost or self.base.lost

    @property
    def late(self) -> bool:
        """Whether a decision in one of the trials was cut off by the clock."""
        return self.mind.late or self.base.late

    def apart(self, sure: Collection[str]) -> Apart | None:
        """Why a pair that was played is not of the scenario; `sure` are the eventful ones."""
        if not (self.played and self.mind.ended):
            return None
        if self.happened == NOTHING_TO_DO:
            return NOTHING_TO_DO
        return NO_EVENT if self.mind.event is None and self.intended in sure else None

    @property
    def meeting(self) -> Meeting:
        """Whether the robots met the same event."""
        mind, base = self.mind, self.base
        if mind.event is None and base.event is None:
            return "nothing"
        if mind.event == base.event and mind.before[-1:] == base.before[-1:]:
            return "same" if mind.before == base.before else "same later"
        common = min(len(side.before) for side in (mind, base) if side.event is not None)
        alike = mind.before[:common] == base.before[:common]
        return "other at once" if alike else "other"


def pairs_of(trials: pl.DataFrame, world: World, mind: str, base: str) -> Iterator[Pair]:
    """The pairs of two robots, as they become complete; others' trials are passed over."""
    own = trials.filter(pl.col("robot").is_in([mind, base]))
    rows = {row["trial"]: row for row in measured(own).iter_rows(named=True)}
    for minds, bases in joined(records_of(own), (mind, base)):
        row = rows[minds.trial]
        least = {name: row[column] for name, column in LEAST.items()}
        yield Pair(
            intended=minds.scenario,
            happened=classify(minds, world),
            solvable=row["solvable"],
            mind=_side(minds, row, world),
            base=_side(bases, rows[bases.trial], world),
            state=row["state"],
            minimal={name: value for name, value in least.items() if value is not None},
        )


def _side(record: TrialRecord, row: Mapping[str, Any], world: World) -> Side:
    """`row` is the measured trial."""
    event = record.exogenous[0] if record.exogenous else None
    until = record.steps if event is None else event.step
    return Side(
        trial=record.trial,
        lost=row["lost"],
        ended=row["ended"],
        late=row["late"],
        achieved=record.achieved,
        correct=record.correct is True,
        decided=record.correct is not None,
        out_of_reach=record.in_reach is False,
        outcome=record.outcome,
        event=None if event is None else event.action,
        undone=event is not None and undone(record, event, world),
        before=tuple(a.action for a in record.actions if a.step <= until),
        measures={name: row[name] for name in DIVIDED},
    )


def undone(record: TrialRecord, event: Occurrence, world: World) -> bool:
    """Whether a literal of the goal is false after an event that would else be true there."""
    before, after = state_at(record, world, event.step), state_at(record, world, event.step + 1)
    own = [a.action for a in record.actions if a.step == event.step and a.happened]
    return any(
        world.holds(without, literal) and not world.holds(after, literal)
        for without in world.successors(before, own)
        for literal in record.goal
    )
