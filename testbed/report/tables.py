"""The table of a run: one row per scenario (or level) and robot, means over their trials."""

from collections import Counter
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import polars as pl

from testbed.analysis.comparison import Apart
from testbed.experiment.record import COARSE, FAILURES, OUTCOMES, Outcome
from testbed.experiment.timeline import exception, in_words, of_place, place
from testbed.text import counted
from testbed.text.grid import Grid

NUMBERS = ("plans", "actions", "exec. units", "planning")
COLUMNS = ("scenario", "robot", "achieved", *NUMBERS, "explained by")
AT_LEVELS = {"scenario": "level", "planning": "coarse planning"}
MEANS = ("plans", "action_count", "execution_units")
MOST_COMMON = 3
TOLD_APART = [Apart.NOTHING_TO_DO, Apart.WITHOUT_EVENT, Apart.DEADLINE]
"""Why trials have rows of their own."""
UNJUDGED = "the fewest actions are not known: more than limits.judge_states states"


@dataclass(frozen=True)
class Row:
    """What the trials of one robot in one scenario, or at one level, come to; means of numbers.

    `apart` says of trials with rows of their own that their pairs are compared in none. Trials that
    the robot's own error ended (`failed`) count as trials, not achieved, and in no mean; those that
    something else ended (`lost`) are none of its `trials`.
    """

    scenario: str
    level: str
    apart: str | None
    robot: str
    trials: int
    lost: int
    failed: int
    achieved: int
    plans: float | None
    action_count: float | None
    execution_units: float | None
    planning_cpu_s: float | None
    explanations: list[list[Mapping[str, Any]]]
    reasons: list[str]
    endings: list[Outcome]

    @property
    def place(self) -> str:
        """What the row is called, beside the robot."""
        return self._named(place(self.scenario, self.level))

    def cells(self) -> tuple[str, ...]:
        """The row as text, in the order of `COLUMNS`."""
        form = ".0f" if self.trials == 1 else ".1f"
        means = (getattr(self, name) for name in MEANS)
        numbers = ("-" if mean is None else format(mean, form) for mean in means)
        seconds = self.planning_cpu_s
        planning = "-" if seconds is None else f"{1000 * seconds:.0f} ms"
        return self.place, self.robot, self._achieved(), *numbers, planning, self._explained()

    def notes(self) -> tuple[str, ...]:
        """What is to be known of trials that were played to their end, one line each."""
        whose = f"{self._named(of_place(self.scenario, self.level))}, {self.robot}"
        reasons = Counter(self.reasons).items()
        if self.trials == 1:
            return tuple(f"{whose}: {reason}" for reason, _ in reasons)
        return tuple(f"{whose}: {reason} in {n} of {self.trials} trials" for reason, n in reasons)

    def _named(self, where: str) -> str:
        if self.apart == Apart.NOTHING_TO_DO:
            return Apart.NOTHING_TO_DO
        return where if self.apart is None else f"{where}, {self.apart}"

    def _achieved(self) -> str:
        """How many, and how the others ended, in the order in which outcomes are declared."""
        lost, counts = [f"{self.lost} lost"] * (self.lost > 0), Counter(self.endings)
        others = [name for name in OUTCOMES if counts[name] and name != "achieved"]
        if self.trials == 1:
            share, told = "yes" if self.achieved else "no", [in_words(name) for name in others]
        else:
            share = f"{self.achieved}/{self.trials}" if self.trials else "-"
            told = [f"{counts[name]} {in_words(name)}" for name in others]
        return ", ".join([share, *told, *lost])

    def _explained(self) -> str:
        counts = list(Counter(text for own in self.explanations for text in explained(own)).items())
        if self.trials > 1:
            counts.sort(key=lambda item: (-item[1], item[0]))
        common = counts[:MOST_COMMON]
        texts = [text if self.trials == 1 else f"{text} x{count}" for text, count in common]
        rest = len(counts) - len(common)
        return ", ".join([*texts, *[counted(rest, "other")] * (rest > 0)]) or "-"


def explained(explanations: Iterable[Mapping[str, Any]]) -> list[str]:
    """What the robot explained in a trial, each once, in the order of its steps.

    These are the exogenous actions that it assumed, and the exceptions, which hold from step 0 on.
    """
    told = list(explanations)
    events = sorted((at["step"], at["action"]) for own in told for at in own["unobserved"])
    exceptions = sorted(exception(literal) for own in told for literal in own["exceptions"])
    return list(dict.fromkeys([*exceptions, *(action for _, action in events)]))


def rows_of(trials: pl.DataFrame) -> list[Row]:
    """The rows of a table: places as the trials name them first, robots by name.

    The column `apart` says why the pair of a trial is not compared, or is null. Where the event of
    their scenario never fired, or a decision was cut off by the clock, pairs have rows behind it;
    where there was nothing to do, rows at the end; others stand in their scenario, where it is told
    how they ended.
    """
    failure, own = pl.col("outcome").is_in(FAILURES), pl.col("cause").eq_missing("robot")
    lost, told_apart = (failure & ~own, pl.col("apart").is_in(TOLD_APART))
    unjudged = pl.when(pl.col("minimal_reason") == "budget").then(pl.lit(UNJUDGED))
    groups = trials.with_columns(
        apart=pl.when(told_apart).then("apart"),
        scenario=pl.when(pl.col("apart").eq_missing(Apart.NOTHING_TO_DO))
        .then(pl.lit(""))
        .otherwise("scenario"),
        reasons=pl.concat_list("reason", unjudged),
    ).group_by("scenario", "level", "apart", "robot", maintain_order=True)
    rows = groups.agg(
        pl.col(*MEANS, "planning_cpu_s").filter(~failure).mean(),
        pl.col("explanations").filter(~failure),
        pl.col("reasons").filter(~failure).explode().drop_nulls(),
        trials=(~lost).sum(),
        lost=lost.sum(),
        failed=(failure & own).sum(),
        achieved=(pl.col("achieved") & ~failure).sum(),
        endings=pl.col("outcome").filter(~lost),
    )
    known = [Row(**row) for row in rows.iter_rows(named=True)]
    names = dict.fromkeys((row.scenario, row.level) for row in known)
    places = {name: number for number, name in enumerate(names)}

    def order(row: Row) -> tuple[bool, int, str, str]:
        where = places[row.scenario, row.level]
        return row.apart == Apart.NOTHING_TO_DO, where, row.apart or "", row.robot

    return sorted(known, key=order)


def headings(rows: Iterable[Row]) -> tuple[str, ...]:
    """The columns by the names that fit the rows.

    Where all have a level that is the first, and planning is said to be the coarse one alone.
    """
    fine = all(row.level != COARSE for row in rows)
    return tuple(AT_LEVELS.get(name, name) for name in COLUMNS) if fine else COLUMNS


def grid(rows: Sequence[Row]) -> Grid:
    """The table for a terminal, with an empty line between scenarios, or levels."""
    cells: list[Sequence[str] | None] = []
    for before, row in zip((None, *rows), rows, strict=False):
        cells += [None] * (before is not None and before.place != row.place)
        cells.append(row.cells())
    return Grid(headings(rows), cells, numbers=range(3, len(COLUMNS) - 1))
