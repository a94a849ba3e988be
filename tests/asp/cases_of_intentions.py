"""Cases for (1)-(16): mental fluents and actions."""

from __future__ import annotations

from tests.asp.axioms import Always, never
from tests.asp.stories import GATE_OPEN, GOAL, OTHER_GOAL, Case, activity, lines, may_occur, occurs

_OPEN = lines(GATE_OPEN, GOAL)
_CROSSING = lines(_OPEN, activity(1, "go(right)"))

CASES = (
    Case(
        1,
        "a started activity has index 0",
        lines(_OPEN, occurs("start(1)")),
        Always("holds(current_action_index(1,0),1)"),
        rule=1,
    ),
    Case(
        1,
        "a stopped activity has index -1",
        lines(_OPEN, occurs("start(1)", "stop(1)")),
        Always("holds(current_action_index(1,-1),2)"),
        n=2,
        rule=2,
    ),
    Case(
        2,
        "selecting a goal that does not hold makes it active",
        lines(_OPEN, occurs("select(my_goal)")),
        Always("holds(active_goal(my_goal),1)"),
        rule=1,
    ),
    Case(
        2,
        "abandoning a goal makes it inactive",
        lines(_OPEN, occurs("select(my_goal)", "abandon(my_goal)")),
        Always("-holds(active_goal(my_goal),2)"),
        n=2,
        rule=2,
    ),
    Case(
        3,
        "executing its next action advances the index of an activity",
        lines(_CROSSING, occurs("select(my_goal)", "start(1)", "go(right)")),
        Always("holds(current_action_index(1,1),3)"),
        n=3,
    ),
    Case(
        4,
        "starting an activity makes the next name available",
        lines(_OPEN, occurs("start(1)")),
        Always("holds(next_available_name(2),1)"),
    ),
    Case(
        5,
        "an activity that has a new index lost the old one",
        lines(_OPEN, occurs("start(1)")),
        Always("-holds(current_action_index(1,-1),1)"),
    ),
    Case(
        6,
        "a started activity is active",
        lines(_OPEN, occurs("start(1)")),
        Always("holds(active_activity(1),1)"),
    ),
    Case(
        7,
        "a goal is not active any more once it holds",
        lines(_OPEN, occurs("select(my_goal)", "go(right)")),
        Always("-holds(active_goal(my_goal),2)"),
        n=2,
    ),
    Case(
        8,
        "an active activity for an active goal is in progress",
        lines(_CROSSING, occurs("select(my_goal)", "start(1)")),
        Always("holds(in_progress_activity(1),2)"),
        n=2,
        rule=1,
    ),
    Case(
        8,
        "an active goal with an active activity is in progress",
        lines(_CROSSING, occurs("select(my_goal)", "start(1)")),
        Always("holds(in_progress_goal(my_goal),2)"),
        n=2,
        rule=2,
    ),
    Case(
        9,
        "the next action of an activity just started is its first component",
        lines(_CROSSING, occurs("select(my_goal)", "start(1)")),
        Always("holds(next_action(1,go(right)),2)"),
        n=2,
    ),
    Case(
        10,
        "a name that was used is not available",
        lines(_OPEN, occurs("start(1)")),
        Always("-holds(next_available_name(1),1)"),
    ),
    Case(
        11,
        "the goal holds when all of its literals do, the negative ones too",
        lines("goal(at(left),true). goal(shut,false).", GATE_OPEN),
        Always("holds(my_goal,0)"),
    ),
    Case(
        12,
        "an active activity cannot be started",
        lines(_OPEN, occurs("start(1)"), may_occur(1, "start(1)")),
        never("occurs(start(1),1)"),
        rule=1,
    ),
    Case(
        12,
        "an inactive activity cannot be stopped",
        lines(_OPEN, may_occur(0, "stop(1)")),
        never("occurs(stop(1),0)"),
        rule=2,
    ),
    Case(
        13,
        "a physical action excludes a mental one",
        lines(_OPEN, may_occur(0, "go(right)", "start(1)")),
        never("occurs(go(right),0)", "occurs(start(1),0)"),
        rule=1,
    ),
    Case(
        13,
        "a mental action excludes another one",
        lines(_OPEN, may_occur(0, "start(1)", "start(2)")),
        never("occurs(start(1),0)", "occurs(start(2),0)"),
        rule=2,
    ),
    Case(
        14,
        "finishing excludes physical actions",
        lines(_OPEN, may_occur(0, "go(right)", "finish")),
        never("occurs(go(right),0)", "occurs(finish,0)"),
        rule=1,
    ),
    Case(
        14,
        "finishing excludes mental actions",
        lines(_OPEN, may_occur(0, "start(1)", "finish")),
        never("occurs(start(1),0)", "occurs(finish,0)"),
        rule=2,
    ),
    Case(
        15,
        "an active goal cannot be selected",
        lines(_OPEN, occurs("select(my_goal)"), may_occur(1, "select(my_goal)")),
        never("occurs(select(my_goal),1)"),
        rule=1,
    ),
    Case(
        15,
        "an inactive goal cannot be abandoned",
        lines(_OPEN, OTHER_GOAL, may_occur(0, "abandon(other)")),
        never("occurs(abandon(other),0)"),
        rule=2,
    ),
    Case(
        16,
        "goals are not selected during a physical action",
        lines(_OPEN, may_occur(0, "switch_on", "select(my_goal)")),
        never("occurs(switch_on,0)", "occurs(select(my_goal),0)"),
        rule=1,
    ),
    Case(
        16,
        "goals are not selected during an exogenous action",
        lines(_OPEN, may_occur(0, "shut_gate", "select(my_goal)")),
        never("occurs(shut_gate,0)", "occurs(select(my_goal),0)"),
        rule=2,
    ),
    Case(
        16,
        "goals are not abandoned during a mental action",
        lines(_OPEN, occurs("select(my_goal)"), may_occur(1, "start(1)", "abandon(my_goal)")),
        never("occurs(start(1),1)", "occurs(abandon(my_goal),1)"),
        n=2,
        rule=3,
    ),
)
