"""Pairs of trials at a level, with zooming and without: what each robot met, and what it did."""

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from typing import Any, Literal

import polars as pl

from testbed.analysis.pairs import OTHER, pairs_of
from testbed.studies.levels.measures import ROBOTS, fine_trials
from testbed.studies.levels.published import PARTS

Meeting = Literal["nothing", "same", "longer", "other"]
MEETINGS: Mapping[Meeting, str] = {
    "nothing": "nothing exogenous happened to either robot",
    "same": "the same exogenous actions, each at the same step of the robot",
    "longer": "the same, and more to one of them after the other's trial had ended",
    "other": "other exogenous actions, or at other steps",
}
COLUMNS = ("trial", "robot", "outcome", "steps", "ended", "achieved", "out_of_reach", "tests")


@dataclass(frozen=True, slots=True)
class Trial:
    """What is kept of one robot's trial in a pair: see `fine_trials` of the study.

    `events` are the exogenous actions with the steps of the robot at which they happened; `did`
    its abstract actions with theirs; `explained` is how often it had to explain an observation.
    `ended` is whether it came to its end without an error, `decided` whether it is known if it was
    `correct`; `seconds` are by the names of PARTS.
    """

    trial: str
    robot: str
    outcome: str
    steps: int
    initial: tuple[str, ...]
    goal: tuple[str, ...]
    events: tuple[tuple[int, str], ...]
    did: tuple[tuple[int, str], ...]
    explained: int
    ended: bool
    achieved: bool
    decided: bool
    correct: bool
    out_of_reach: bool
    plans: int
    actions: int
    tests: int
    seconds: Mapping[str, float]


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
        return self.zoom.achieved and self.no_zoom.achieved

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


def _work(own: Trial) -> tuple[object, ...]:
    return own.steps, own.did, own.plans, own.actions, own.tests


def pairs_in(trials: pl.DataFrame) -> Iterator[Pair]:
    """The pairs of the two conditions in a run's trials, as they become complete."""
    own = trials.filter(pl.col("fine").is_not_null())
    further = own.select(
        "trial",
        "seed",
        "steps",
        "initial",
        "goal",
        "explanations",
        events="exogenous",
        did="actions",
    )
    rows = fine_trials(own).join(further, on="trial", maintain_order="left")
    for row in pairs_of(rows, ROBOTS).iter_rows(named=True):
        yield Pair(row["level"], row["seed"], _trial(row, OTHER), _trial(row, ""))


def _trial(row: Mapping[str, Any], who: str) -> Trial:
    own = {name: row[name + who] for name in COLUMNS}
    events, did = (
        tuple((at["step"], at["action"]) for at in row[name + who]) for name in ("events", "did")
    )
    seconds = {part: row[part + who] for part in PARTS}
    return Trial(
        **own,
        initial=tuple(row["initial" + who]),
        goal=tuple(row["goal" + who]),
        events=events,
        did=did,
        explained=len(row["explanations" + who]),
        decided=row["correct" + who] is not None,
        correct=row["correct" + who] is True,
        plans=row["refined_plans" + who],
        actions=row["concrete_actions" + who],
        seconds={part: value for part, value in seconds.items() if value is not None},
    )
