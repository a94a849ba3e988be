"""The pairs of a run: which scenario each came to be (P 4), and whether both met the same."""

from collections.abc import Collection, Mapping, Sequence
from typing import Any, Literal

import polars as pl

from asp.language import Action
from testbed.analysis.comparison import Apart, measured, with_apart
from testbed.analysis.pairs import OTHER, Compared, pairs_of
from testbed.analysis.table import Trials, records_of
from testbed.experiment.record import Activity, Occurrence, TrialRecord
from testbed.world import World

UNCLASSIFIED = "unclassified"
FAILURE_TO_EXECUTE = "6"
Meeting = Literal["nothing", "same", "same later", "other", "other at once"]
MEETINGS: Mapping[Meeting, str] = {
    "nothing": "nothing exogenous happened to either",
    "same": "same event beside the same action, after the same actions",
    "same later": "same event beside the same action; before it the robots had acted differently",
    "other": "not the same event and action: before it the robots had acted differently",
    "other at once": "not the same event and action, although the robots had acted alike",
}
TOLD: Mapping[str, Any] = {
    "event": pl.String,
    "undone": pl.Boolean,
    "before": pl.List(pl.String),
    "happened": pl.String,
}
"""What is read off each trial."""


def pairs_in(trials: Trials, world: World, robots: Compared, sure: Collection[str]) -> pl.DataFrame:
    """The pairs of two robots as `pairs_of` has them, with what their trials came to.

    The `event` of a trial is its first, null where nothing exogenous happened; `undone` says
    whether that took away a part of the goal that would have been true; `before` are the robot's
    actions up to the one that the event goes with, or all. What `happened` of the treatment's is
    the scenario of the pair, `meeting` whether both met the same event. `apart` says why a pair is
    not compared; `sure` are the eventful scenarios.
    """
    own = trials.lazy().filter(pl.col("robot").is_in(robots))
    told = [_told(record, world, robots.treatment) for record in records_of(own)]
    rows = measured(own).hstack(pl.DataFrame(told, schema=TOLD, orient="row"))
    pairs = pairs_of(with_apart(rows, robots, sure), robots)
    columns = ("event" + OTHER, "before" + OTHER, "event", "before")
    met = [meeting(*row) for row in pairs.select(columns).iter_rows()]
    return pairs.with_columns(
        pl.Series("meeting", met, pl.String), happened=pl.col("happened" + OTHER)
    )


def _told(record: TrialRecord, world: World, treatment: str) -> tuple[object, ...]:
    """In the order of `TOLD`; only the treatment's trial says what happened."""
    event = record.exogenous[0] if record.exogenous else None
    until = record.steps if event is None else event.step
    return (
        None if event is None else str(event.action),
        event is not None and undone(record, event, world),
        [str(own.action) for own in record.actions if own.step <= until],
        classify(record, world) if record.robot == treatment else None,
    )


def meeting(
    event: str | None, before: Sequence[str], other: str | None, before_other: Sequence[str]
) -> Meeting:
    """Whether two robots met the same event, and had acted alike before it."""
    if event is None and other is None:
        return "nothing"
    if event == other and before[-1:] == before_other[-1:]:
        return "same" if before == before_other else "same later"
    told = ((event, before), (other, before_other))
    common = min(len(actions) for met, actions in told if met is not None)
    return "other at once" if before[:common] == before_other[:common] else "other"


def undone(record: TrialRecord, event: Occurrence, world: World) -> bool:
    """Whether a literal of the goal is false after an event that would else be true there."""
    before, after = state_at(record, world, event.step), state_at(record, world, event.step + 1)
    own = [a.action for a in record.actions if a.step == event.step and a.happened]
    return any(
        world.holds(without, literal) and not world.holds(after, literal)
        for without in world.successors(before, own)
        for literal in record.goal
    )


def classify(record: TrialRecord, world: World) -> str:
    """The scenario that a trial came to be, `1` to `6`; or nothing to do; or that no rule fits.

    Read off what the intentional robot did, as in the original experiments: its activities, and
    what it could see when it stopped the first of them. The record is that of a robot with
    activities, at the coarse resolution.
    """
    if record.achieved and not (record.activities or record.actions or record.failed):
        return Apart.NOTHING_TO_DO
    if not record.activities:
        return UNCLASSIFIED
    first = record.activities[0]
    until = record.steps + 1 if first.stop is None else first.stop
    executed = sum(first.start <= attempt.step < until for attempt in record.actions)
    whole = executed == len(first.plan)
    if first.stop is not None and whole:
        return "5"
    if len(record.activities) == 1 and first.stop is None:
        if whole:
            return "1"
        return "2" if record.achieved else UNCLASSIFIED
    return _replanned(record, first, world)


def _replanned(record: TrialRecord, first: Activity, world: World) -> str:
    """Stopped before its end: after a lock, or a move, seen (4) or not where the thing went (3)."""
    if not record.exogenous or first.stop is None:
        return UNCLASSIFIED
    event = record.exogenous[0].action
    # Exogenous actions that make the robot's own fail, by the domain's scenario of that.
    locking = (t.event.name for t in world.description.triggers if t.scenario == FAILURE_TO_EXECUTE)
    if event.name in locking:
        return FAILURE_TO_EXECUTE
    effects = {law.head for law in world.description.causal if law.action == event}
    seen = world.visible(state_at(record, world, first.stop), world.description.robots[0])
    return "4" if effects.intersection(seen) else "3"


def state_at(record: TrialRecord, world: World, step: int) -> int:
    """The state of the world at the beginning of a step of a recorded trial."""
    state = world.state(record.initial)
    compounds: dict[int, list[Action]] = {}
    physical = [(a.step, a.action) for a in record.actions if a.happened]
    for number, action in [*physical, *((e.step, e.action) for e in record.exogenous)]:
        compounds.setdefault(number, []).append(action)
    for number in sorted(compounds):
        if number < step:
            state = world.successor(state, compounds[number])
    return state
