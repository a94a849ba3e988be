"""Cases for (28)-(41): the three situations, and an activity in progress."""

from tests.asp.reasoning.stories import (
    GATE_OPEN,
    GATE_SHUT,
    GOAL,
    SELECTED,
    STARTED,
    Case,
    activity,
    happened,
    intending,
    lines,
)
from tests.asp.theories.axioms import Always, Inconsistent, possible

_OPEN = lines(GATE_OPEN, GOAL)
_SHUT = lines(GATE_SHUT, GOAL)
# The goal was just selected; a plan is looked for at step 1.
_PLANNING = lines(_OPEN, SELECTED, intending(1))
# The plan to cross was just started; its first action is due at step 2.
_CROSSING = lines(_OPEN, STARTED, activity(1, "go(right)"), intending(2))
_BLOCKED = lines(_SHUT, STARTED, activity(1, "go(right)"), intending(2))
_IN_TWO_STEPS = lines(_SHUT, STARTED, activity(1, "open", "go(right)"), intending(2))
_CROSSED_BY_OTHERS = lines(
    _OPEN, STARTED, activity(1, "go(right)"), happened(2, "push(right)"), intending(3)
)
_ABANDONED = lines(
    _OPEN, STARTED, activity(1, "go(right)"), happened(2, "abandon(my_goal)"), intending(3)
)
_ACHIEVED_BEFORE_ANY_PLAN = lines(_OPEN, SELECTED, happened(1, "push(right)"), intending(2))

CASES = (
    Case(
        28,
        "different plans of one length are different activities",
        lines(_OPEN, activity(1, "go(right)"), activity(2, "open")),
        possible(),
        rule=1,
    ),
    *(
        Case(
            28,
            "two activities do not have one goal and one plan",
            lines(_OPEN, activity(1, "go(right)"), activity(2, "go(right)")),
            Inconsistent(),
            rule=rule,
        )
        for rule in (2, 3, 4)
    ),
    Case(
        29,
        "a goal just selected has no activity",
        _PLANNING,
        Always("no_activity_for_goal(my_goal,1)"),
        n=3,
    ),
    Case(
        30,
        "an activity whose goal someone else achieved has no goal",
        _CROSSED_BY_OTHERS,
        Always("no_goal_for_activity(1,3)"),
        n=4,
    ),
    Case(
        31,
        "an activity just started is active for its goal",
        _CROSSING,
        Always("active_goal_activity(1,2)"),
        n=3,
    ),
    Case(
        32,
        "the robot finishes when the goal of its activity was abandoned",
        _ABANDONED,
        Always("intended_action(finish,3)"),
        n=4,
    ),
    Case(
        33,
        "a selected goal that someone else achieved holds",
        _ACHIEVED_BEFORE_ANY_PLAN,
        Always("selected_goal_holds(my_goal,2)"),
        n=3,
    ),
    Case(
        34,
        "the robot finishes when its goal holds before it has a plan",
        _ACHIEVED_BEFORE_ANY_PLAN,
        Always("intended_action(finish,2)"),
        n=3,
    ),
    Case(
        35,
        "the components of the activity in progress are expected to occur, one after the other",
        _IN_TWO_STEPS,
        Always("occurs(go(right),3)"),
        n=4,
    ),
    Case(
        36,
        "an activity that leads to its goal has projected success",
        _IN_TWO_STEPS,
        Always("projected_success(1,2)"),
        n=4,
    ),
    Case(
        37,
        "an activity whose next action is impossible has none",
        _BLOCKED,
        Always("-projected_success(1,2)"),
        n=3,
    ),
    Case(
        38,
        "the robot intends the next action of an activity with projected success",
        _CROSSING,
        Always("intended_action(go(right),2)"),
        n=3,
    ),
    Case(
        39,
        "an activity without projected success is futile, whatever else is intended",
        lines(_BLOCKED, "intended_action(finish,2)."),
        Always("futile_activity(1,2)"),
        n=3,
    ),
    Case(
        40,
        "an activity without projected success can be declared futile",
        _BLOCKED,
        possible("futile_activity(1,2)"),
        n=3,
    ),
    Case(41, "a futile activity is stopped", _BLOCKED, Always("intended_action(stop(1),2)"), n=3),
)
