"""The pairs of a run, one object each, as the sections of the page count them."""

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from typing import Any

import polars as pl

from asp.language import Action, Literal
from testbed.analysis.comparison import DIVIDED
from testbed.analysis.pairs import OTHER
from testbed.studies.table1.measures import LEFT_OUT
from testbed.studies.table1.pairs import Meeting, meeting


@dataclass(frozen=True, slots=True)
class Side:
    """One robot's trial in a pair: its columns in `testbed.studies.table1.pairs.pairs_in`.

    `decided`: whether it is known if it was correct.
    """

    trial: str
    achieved: bool
    correct: bool
    outcome: str
    event: Action | None
    undone: bool
    before: tuple[str, ...]
    measures: Mapping[str, float]
    decided: bool = True
    ended: bool = True


@dataclass(frozen=True, slots=True)
class Pair:
    """Both robots' trials; `happened` is the scenario read off the treatment's.

    `state` names the initial state; `apart` says why the pair is not compared.
    """

    intended: str
    happened: str
    treatment: Side
    baseline: Side
    state: str
    apart: str | None = None

    @property
    def played(self) -> bool:
        """Whether both trials say something of their robots, and some plan achieves the goal."""
        return self.apart not in LEFT_OUT.values()

    @property
    def decided(self) -> bool:
        """Whether it is known of both trials if they were correct."""
        return self.treatment.decided and self.baseline.decided

    @property
    def ended(self) -> bool:
        """Whether no robot's own error ended its trial: the measures are of whole trials."""
        return self.treatment.ended and self.baseline.ended

    @property
    def meeting(self) -> Meeting:
        """Whether the robots met the same event."""
        own, base = self.treatment, self.baseline
        return meeting(own.event, own.before, base.event, base.before)


def each(pairs: pl.DataFrame) -> Iterator[Pair]:
    """The rows of `testbed.studies.table1.pairs.pairs_in`."""
    for row in pairs.iter_rows(named=True):
        sides = _side(row, OTHER), _side(row, "")
        yield Pair(row["scenario"], row["happened"], *sides, row["state"], row["apart"])


def _side(row: Mapping[str, Any], who: str) -> Side:
    columns = ("trial", "achieved", "outcome", "undone", "ended")
    correct = row["correct" + who]
    return Side(
        **{name: row[name + who] for name in columns},
        event=None if row["event" + who] is None else Literal.parse(row["event" + who]),
        correct=correct is True,
        decided=correct is not None,
        before=tuple(row["before" + who]),
        measures={name: row[name + who] for name in DIVIDED},
    )
