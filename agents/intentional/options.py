"""The intention where several things may be so, by outcomes of actions."""

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, replace

from agents.intentional.activities import History, start_activity, stop_activity
from agents.shared import Course, Intention, Outlook
from asp.language import Action
from asp.reasoning import Goal, Knowledge, place_of
from asp.reasoning.diagnosis import GOAL, Diagnosis
from asp.solving import State
from testbed.protocol import FINISH


@dataclass(frozen=True)
class Option:
    """What may be so at a step under one explanation, by outcomes of actions.

    A state, and the index of the activity that is carried out in it, by name.
    """

    state: State
    indices: Mapping[int, int]


def intended(
    options: Sequence[Option],
    history: History,
    diagnosis: Diagnosis,
    outlook: Outlook,
    goal: Goal,
    limit: int,
) -> Intention:
    """The intention where one of the options is so; as of the theory (28)-(53).

    Where there are several the intention's `under` says which of them is believed.
    """
    states = [option.state for option in options]
    courses = [Course(option.state, history.left(option.indices)) for option in options]

    def under(option: Option) -> Diagnosis | None:
        return None if len(options) == 1 else replace(diagnosis, indices=option.indices)

    def believing(state: State, action: Action, plan: tuple[Action, ...] = ()) -> Intention:
        return Intention(action, plan, state, under(options[states.index(state)]))

    active = next(iter(options[0].indices), None)
    if active is not None and (course := outlook.succeeding(courses, goal)) is not None:
        chosen = options[courses.index(course)]
        return Intention(course.left[0], (), course.state, under(chosen))  # (38)
    if (state := outlook.achieved(states, goal)) is not None:
        own = believing(state, FINISH)
        return replace(own, believed=state | {GOAL})  # (34)
    if active is not None:
        return believing(states[0], stop_activity(active))  # (41)
    found = outlook.shortest(states, goal, limit)
    if found is None:
        return believing(states[0], FINISH)  # (53)
    earlier = (activity.name for activity in history.activities if activity.plan == found.left)
    name = next(earlier, len(history.activities) + 1)
    return believing(found.state, start_activity(name), found.left)  # (42), (52)


def in_order(options: Iterable[Option], knowledge: Knowledge) -> list[Option]:
    """The options in the order of `planning.lp` (b)."""
    fluents = knowledge.description.fluents
    return sorted(options, key=lambda o: (place_of(o.state, fluents), -sum(o.indices.values())))
