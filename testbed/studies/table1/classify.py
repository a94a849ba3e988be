"""Which scenario a trial came to be, read off what the intentional robot did in it (P 4).

As in the original experiments: by its activities, and by what it could see when it stopped the
first of them.
"""

from asp.language import Action
from testbed.analysis.comparison import NOTHING_TO_DO
from testbed.experiment.record import Activity, TrialRecord
from testbed.world import World

__all__ = ["NOTHING_TO_DO", "UNCLASSIFIED", "classify", "state_at"]

UNCLASSIFIED = "unclassified"
FAILURE_TO_EXECUTE = "6"


def classify(record: TrialRecord, world: World) -> str:
    """`1` to `6`; or that the goal held from the start; or that no rule fits.

    The record is that of a robot with activities, at the coarse resolution.
    """
    if record.achieved and not (record.activities or record.actions or record.failed):
        return NOTHING_TO_DO
    if not record.activities:
        return UNCLASSIFIED
    first = record.activities[0]
    whole = _executed(record, first) == len(first.plan)
    if first.stop is not None and whole:
        return "5"
    if len(record.activities) == 1 and first.stop is None:
        if whole:
            return "1"
        return "2" if record.achieved else UNCLASSIFIED
    return _replanned(record, first, world)


def _executed(record: TrialRecord, activity: Activity) -> int:
    """How many actions of an activity were attempted before it was stopped."""
    until = record.steps + 1 if activity.stop is None else activity.stop
    return sum(activity.start <= attempt.step < until for attempt in record.actions)


def _replanned(record: TrialRecord, first: Activity, world: World) -> str:
    """Stopped before its end: after a lock, or a move, seen (4) or not where the thing went (3)."""
    if not record.exogenous or first.stop is None:
        return UNCLASSIFIED
    event = record.exogenous[0].action
    if event.name in _locking(world):
        return FAILURE_TO_EXECUTE
    effects = {law.head for law in world.description.causal if law.action == event}
    seen = world.visible(state_at(record, world, first.stop), world.description.robots[0])
    return "4" if effects.intersection(seen) else "3"


def _locking(world: World) -> set[str]:
    """The exogenous actions that make the robot's own fail, by the domain's scenario of that."""
    triggers = world.description.triggers
    return {t.event.name for t in triggers if t.scenario == FAILURE_TO_EXECUTE}


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
