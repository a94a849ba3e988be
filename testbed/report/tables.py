"""The table of a run: one row a scenario (or level) and robot, means over their trials."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field

from testbed.analysis.comparison import DEADLINE, NO_EVENT, NOTHING_TO_DO, Apart
from testbed.experiment.record import COARSE, OUTCOMES, Outcome, TrialRecord
from testbed.experiment.timeline import exception, in_words, of_place, place
from testbed.text.grid import Grid
from testbed.text.wording import counted

COLUMNS = (
    "scenario",
    "robot",
    "achieved",
    "plans",
    "actions",
    "exec. units",
    "planning",
    "explained by",
)
AT_LEVELS = {"scenario": "level", "planning": "coarse planning"}
MOST_COMMON = 3
UNJUDGED = "the fewest actions are not known: more than limits.judge_states states"
NONE_APART: Mapping[str, Apart] = {}


@dataclass
class Row:
    """What the trials of one robot in one scenario, or at one level, come to: sums for means.

    `apart` says of trials with rows of their own that their pairs are compared in none. Trials that
    the robot's own error ended (`failed`) count as trials, not achieved, and in no mean; those that
    something else ended (`lost`) are none of its `trials`.
    """

    scenario: str
    level: str
    apart: Apart | None
    robot: str
    trials: int = 0
    lost: int = 0
    failed: int = 0
    achieved: int = 0
    plans: int = 0
    actions: int = 0
    units: int = 0
    planning_s: float = 0.0
    explanations: Counter[str] = field(default_factory=Counter)
    reasons: Counter[str] = field(default_factory=Counter)
    endings: Counter[Outcome] = field(default_factory=Counter)

    def add(self, record: TrialRecord) -> None:
        """Count one more trial."""
        if record.lost:
            self.lost += 1
            return
        self.trials += 1
        self.endings[record.outcome] += 1
        if record.failed:
            self.failed += 1
            return
        self.achieved += record.achieved
        self.plans += record.plans
        self.actions += record.action_count
        self.units += record.execution_units
        self.planning_s += record.planning_cpu_s
        self.explanations.update(explained(record))
        if record.reason is not None:
            self.reasons[record.reason] += 1
        if record.minimal_reason == "budget":
            self.reasons[UNJUDGED] += 1

    @property
    def place(self) -> str:
        """What the row is called, beside the robot."""
        return self._named(place(self.scenario, self.level))

    def cells(self) -> tuple[str, ...]:
        """The row as text, in the order of `COLUMNS`."""
        return (
            self.place,
            self.robot,
            self._achieved(),
            self._mean(self.plans),
            self._mean(self.actions),
            self._mean(self.units),
            self._planning(),
            self._explained(),
        )

    def notes(self) -> tuple[str, ...]:
        """What is to be known of trials that were played to their end, one line each."""
        whose = f"{self._named(of_place(self.scenario, self.level))}, {self.robot}"
        if self.trials == 1:
            return tuple(f"{whose}: {reason}" for reason in self.reasons)
        trials = f"of {self.trials} trials"
        return tuple(f"{whose}: {reason} in {n} {trials}" for reason, n in self.reasons.items())

    def _named(self, where: str) -> str:
        if self.apart == NOTHING_TO_DO:
            return NOTHING_TO_DO
        return where if self.apart is None else f"{where}, {self.apart}"

    @property
    def _played(self) -> int:
        return self.trials - self.failed

    def _achieved(self) -> str:
        """How many, and how the others ended, in the order in which outcomes are declared."""
        others = [name for name in OUTCOMES if self.endings[name] and name != "achieved"]
        lost = [f"{self.lost} lost"] * (self.lost > 0)
        if not self.trials:
            return ", ".join(["-", *lost])
        if self.trials == 1:
            share = "yes" if self.achieved else "no"
            return ", ".join([share, *map(in_words, others), *lost])
        share = f"{self.achieved}/{self.trials}"
        told = (f"{self.endings[name]} {in_words(name)}" for name in others)
        return ", ".join([share, *told, *lost])

    def _mean(self, total: int) -> str:
        if not self._played:
            return "-"
        return str(total) if self.trials == 1 else f"{total / self._played:.1f}"

    def _planning(self) -> str:
        return f"{1000 * self.planning_s / self._played:.0f} ms" if self._played else "-"

    def _explained(self) -> str:
        counts = list(self.explanations.items())
        if self.trials > 1:
            counts.sort(key=lambda item: (-item[1], item[0]))
        common = counts[:MOST_COMMON]
        texts = [text if self.trials == 1 else f"{text} x{count}" for text, count in common]
        rest = len(self.explanations) - len(common)
        if rest:
            texts.append(counted(rest, "other"))
        return ", ".join(texts) or "-"


def explained(record: TrialRecord) -> list[str]:
    """What the robot explained, each once, in the order of its steps.

    These are the exogenous actions that it assumed, and the exceptions, which hold from step 0 on.
    """
    explanations = record.explanations
    events = [(event.step, event.action) for own in explanations for event in own.unobserved]
    exceptions = [exception(literal) for own in explanations for literal in own.exceptions]
    return list(dict.fromkeys([*sorted(exceptions), *(action for _, action in sorted(events))]))


def rows_of(records: Iterable[TrialRecord], apart: Mapping[str, Apart] = NONE_APART) -> list[Row]:
    """The rows of a table: places as the records name them first, robots by name.

    `apart` are the pairs that are not compared (`counting.pairs_apart`). Where the event of their
    scenario never fired, or a decision was cut off by the clock, they have rows behind it; where
    there was nothing to do, rows at the end; others stand in their scenario, where it is told how
    they ended.
    """
    rows: dict[tuple[str, str, Apart | None, str], Row] = {}
    for record in records:
        key = (*_place(record, apart.get(record.pair)), record.robot)
        rows.setdefault(key, Row(*key)).add(record)
    places = {place: number for number, place in enumerate(dict.fromkeys(k[:2] for k in rows))}
    order = sorted(rows, key=lambda k: (k[2] == NOTHING_TO_DO, places[k[:2]], k[2] or "", k[3]))
    return [rows[key] for key in order]


def _place(record: TrialRecord, reason: Apart | None) -> tuple[str, str, Apart | None]:
    if reason == NOTHING_TO_DO:
        return "", record.level, reason
    return record.scenario, record.level, reason if reason in (NO_EVENT, DEADLINE) else None


def headings(rows: Iterable[Row]) -> tuple[str, ...]:
    """The columns by the names that fit the rows.

    Where all have a level that is the first, and planning is said to be the coarse one alone.
    """
    fine = all(row.level != COARSE for row in rows)
    return tuple(AT_LEVELS.get(name, name) for name in COLUMNS) if fine else COLUMNS


def grid(rows: Sequence[Row]) -> Grid:
    """The table for a terminal, with an empty line between scenarios, or levels."""
    cells: list[Sequence[str] | None] = []
    before: str | None = None
    for row in rows:
        if before not in (None, row.place):
            cells.append(None)
        before = row.place
        cells.append(row.cells())
    return Grid(headings(rows), cells, numbers=range(3, len(COLUMNS) - 1))
