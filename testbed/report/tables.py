"""The table of a run: one row per scenario (or level) and robot, means over their trials."""

from collections import Counter, defaultdict
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import polars as pl

from testbed.analysis.comparison import Apart
from testbed.analysis.table import Trials
from testbed.experiment.record import COARSE, FAILURES, OUTCOMES, Outcome
from testbed.experiment.timeline import exception, in_words, of_place, place
from testbed.text import counted
from testbed.text.grid import Grid

NUMBERS = ("plans", "actions", "exec. units", "planning")
COLUMNS = ("scenario", "robot", "achieved", *NUMBERS, "explained by")
AT_LEVELS = {"scenario": "level", "planning": "coarse planning"}
MEANS = ("plans", "action_count", "execution_units")
MOST_COMMON = 3
GROUP = ("scenario", "level", "apart", "robot")
NEEDED = (*GROUP[:2], "robot", "explanations", "reason", "minimal_reason", "outcome", "cause")
"""Columns of a table of trials that rows are made of."""
TOLD_APART = [Apart.NOTHING_TO_DO, Apart.WITHOUT_EVENT, Apart.DEADLINE]
"""Why trials have rows of their own."""
UNJUDGED = "the fewest actions are not known: more than limits.judge_states states"


@dataclass(frozen=True)
class Row:
    """What the trials of one robot in one scenario, or at one level, come to; means of numbers.

    `apart` says of trials with rows of their own that their pairs are compared in none. Trials that
    the robot's own error ended (`failed`) count as trials, not achieved, and in no mean; those that
    something else ended (`lost`) are none of its `trials`. `explained`, `reasons` and `endings` are
    counted in trials; of a single one they are in its order.
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
    explained: Mapping[str, int]
    reasons: Mapping[str, int]
    endings: Mapping[Outcome, int]

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
        reasons = self.reasons.items()
        if self.trials == 1:
            return tuple(f"{whose}: {reason}" for reason, _ in reasons)
        return tuple(f"{whose}: {reason} in {n} of {self.trials} trials" for reason, n in reasons)

    def _named(self, where: str) -> str:
        if self.apart == Apart.NOTHING_TO_DO:
            return Apart.NOTHING_TO_DO
        return where if self.apart is None else f"{where}, {self.apart}"

    def _achieved(self) -> str:
        """How many, and how the others ended, in the order in which outcomes are declared."""
        lost, counts = [f"{self.lost} lost"] * (self.lost > 0), self.endings
        others = [name for name in OUTCOMES if name in counts and name != "achieved"]
        if self.trials == 1:
            share, told = "yes" if self.achieved else "no", [in_words(name) for name in others]
        else:
            share = f"{self.achieved}/{self.trials}" if self.trials else "-"
            told = [f"{counts[name]} {in_words(name)}" for name in others]
        return ", ".join([share, *told, *lost])

    def _explained(self) -> str:
        counts = list(self.explained.items())
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


def rows_of(trials: Trials, apart: pl.Series) -> list[Row]:
    """The rows of a table: places as the trials name them first, robots by name.

    `apart` says why the pair of a trial is not compared, or is null. Where the event of
    their scenario never fired, or a decision was cut off by the clock, pairs have rows behind it;
    where there was nothing to do, rows at the end; others stand in their scenario, where it is told
    how they ended.
    """
    failure, own = pl.col("outcome").is_in(FAILURES), pl.col("cause").eq_missing("robot")
    lost = failure & ~own
    placed = _placed(trials, apart)
    told = placed.filter(~failure)
    counted = {
        "explained": _counts(_explained(told)),
        "reasons": _counts(_each(told.explode("reasons").drop_nulls("reasons"), "reasons")),
        "endings": _counts(_each(placed.filter(~lost), "outcome")),
    }
    rows = placed.group_by(GROUP, maintain_order=True).agg(
        pl.col(*MEANS, "planning_cpu_s").filter(~failure).mean(),
        trials=(~lost).sum(),
        lost=lost.sum(),
        failed=(failure & own).sum(),
        achieved=(pl.col("achieved") & ~failure).sum(),
    )
    known = [
        Row(**{**row, **{name: own[group] for name, own in counted.items()}})
        for row in rows.iter_rows(named=True)
        for group in [tuple(row[key] for key in GROUP)]
    ]
    names = dict.fromkeys((row.scenario, row.level) for row in known)
    places = {name: number for number, name in enumerate(names)}

    def order(row: Row) -> tuple[bool, int, str, str]:
        where = places[row.scenario, row.level]
        return row.apart == Apart.NOTHING_TO_DO, where, row.apart or "", row.robot

    return sorted(known, key=order)


def _placed(trials: Trials, apart: pl.Series) -> pl.DataFrame:
    """Trials with the group of the row that each is in, and the reasons of what became of it."""
    told_apart = pl.col("apart").is_in(TOLD_APART)
    idle = pl.col("apart").eq_missing(Apart.NOTHING_TO_DO)
    unjudged = pl.when(pl.col("minimal_reason") == "budget").then(pl.lit(UNJUDGED))
    known = trials.lazy().select(*NEEDED, *MEANS, "achieved", "planning_cpu_s").collect()
    return known.with_columns(apart).with_columns(
        apart=pl.when(told_apart).then("apart"),
        scenario=pl.when(idle).then(pl.lit("")).otherwise("scenario"),
        reasons=pl.concat_list("reason", unjudged),
    )


def _explained(trials: pl.DataFrame) -> Iterator[tuple[str, ...]]:
    """By group what was explained, once per trial."""
    telling = trials.filter(pl.col("explanations").list.len() > 0)
    for *group, own in telling.select(*GROUP, "explanations").iter_rows():
        yield from ((*group, text) for text in explained(own))


def _each(trials: pl.DataFrame, column: str) -> Iterator[tuple[str, ...]]:
    return trials.select(*GROUP, column).iter_rows()


def _counts(told: Iterable[tuple[str, ...]]) -> Mapping[tuple[str, ...], Counter[str]]:
    """By group how often each text is there."""
    counts: defaultdict[tuple[str, ...], Counter[str]] = defaultdict(Counter)
    for *group, text in told:
        counts[tuple(group)][text] += 1
    return counts


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
