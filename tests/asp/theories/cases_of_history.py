"""Cases for (17)-(27): the recorded history, and its diagnosis."""

from tests.asp.reasoning.stories import (
    GATE_OPEN,
    GATE_SHUT,
    GOAL,
    OTHER_GOAL,
    Case,
    did,
    failed,
    happened,
    lines,
    may_occur,
)
from tests.asp.theories.axioms import Always, Inconsistent, never, possible

_OPEN = lines(GATE_OPEN, GOAL)
_SHUT = lines(GATE_SHUT, GOAL)
_FOUND_SHUT = lines(_OPEN, "obs(shut,true,1). current_step(1). explaining(1).")
_FOUND_ELSEWHERE = "obs(at(right),true,1)."

CASES = (
    # No current step is given: the reality check (18) is silent.
    Case(
        17,
        "what is seen to be true at the start holds at the start",
        lines(GOAL, "obs(lit,true,0)."),
        Always("holds(lit,0)"),
        rule=1,
    ),
    Case(
        17,
        "what is seen to be false at the start does not hold at the start",
        lines(GOAL, "obs(lit,false,0)."),
        Always("-holds(lit,0)"),
        rule=2,
    ),
    Case(
        18,
        "a belief that is seen to be false is inconsistent",
        lines(_SHUT, "current_step(1). obs(shut,false,1)."),
        Inconsistent(),
        rule=1,
    ),
    Case(
        18,
        "what is believed false and seen to be true is inconsistent",
        lines(_OPEN, "current_step(1). obs(shut,true,1)."),
        Inconsistent(),
        rule=2,
    ),
    Case(
        19,
        "an event that was reported occurred",
        lines(_OPEN, "current_step(1).", happened(0, "shut_gate")),
        Always("holds(shut,1)"),
        rule=1,
    ),
    Case(
        19,
        "an action that was seen not to happen, although possible, is inconsistent",
        lines(_OPEN, "current_step(1).", failed(0, "go(right)")),
        Inconsistent(),
        rule=2,
    ),
    Case(
        20,
        "an attempt that failed was impossible",
        lines("holds(at(left),0).", GOAL, "current_step(1).", failed(0, "go(right)")),
        Always("holds(shut,0)"),
        rule=1,
    ),
    Case(
        20,
        "what no state can follow did not occur, whatever happened beside it",
        lines(_OPEN, "current_step(1). disqualified(switch_on,0).", did(0, "switch_on")),
        Inconsistent(),
        n=1,
        rule=2,
    ),
    Case(
        20,
        "no action of the robot's own occurred that it did not attempt",
        lines(_OPEN, "current_step(1).", may_occur(0, "go(right)")),
        never("occurs(go(right),0)"),
        rule=3,
    ),
    Case(
        21,
        "two goals are not selected at once",
        lines(_OPEN, OTHER_GOAL, "current_step(1).", happened(0, "select(my_goal)"))
        + happened(0, "select(other)"),
        Inconsistent(),
        rule=1,
    ),
    Case(
        21,
        "no goal is selected while an activity is active",
        lines(_OPEN, "current_step(2).", did(0, "start(1)"), happened(1, "select(my_goal)")),
        Inconsistent(),
        n=2,
        rule=2,
    ),
    Case(
        21,
        "no goal is selected while another one is active",
        lines(_OPEN, OTHER_GOAL, "current_step(2).", happened(0, "select(other)"))
        + happened(1, "select(my_goal)"),
        Inconsistent(),
        n=2,
        rule=3,
    ),
    Case(22, "at first no activity is active", _OPEN, never("holds(active_activity(1),0)"), rule=1),
    Case(22, "at first no goal is active", _OPEN, Always("-holds(active_goal(my_goal),0)"), rule=2),
    Case(
        22,
        "at first the first name is available",
        _OPEN,
        Always("holds(next_available_name(1),0)"),
        rule=3,
    ),
    Case(
        23,
        "the result of an attempt may be that it happened",
        lines(_OPEN, "current_step(1).", did(0, "go(right)")),
        possible("holds(at(right),1)"),
        rule=1,
    ),
    Case(
        23,
        "an attempt without a result is inconsistent",
        lines(_OPEN, "current_step(1). attempt(go(right),0)."),
        Inconsistent(),
        rule=2,
    ),
    Case(
        24,
        "no goal is selected unnoticed",
        lines(_OPEN, "current_step(1).", may_occur(0, "select(my_goal)")),
        never("occurs(select(my_goal),0)"),
        rule=1,
    ),
    Case(
        24,
        "no goal is abandoned unnoticed",
        lines(_OPEN, "current_step(2).", happened(0, "select(my_goal)"))
        + may_occur(1, "abandon(my_goal)"),
        never("occurs(abandon(my_goal),1)"),
        n=2,
        rule=2,
    ),
    Case(
        25,
        "a gate found shut was shut by someone",
        _FOUND_SHUT,
        Always("occurs(shut_gate,0)"),
        limit=1,
    ),
    Case(
        26,
        "an event that explains and was not reported is unobserved",
        _FOUND_SHUT,
        Always("unobserved(shut_gate,0)"),
        limit=1,
    ),
    Case(
        27,
        "events are counted by their occurrences: two unobserved ones",
        lines(_FOUND_SHUT, _FOUND_ELSEWHERE),
        Always("number_unobserved(2,1)"),
        limit=2,
        rule=1,
    ),
    Case(
        27,
        "two changes are not explained by one event",
        lines(_FOUND_SHUT, _FOUND_ELSEWHERE),
        Inconsistent(),
        limit=1,
        rule=2,
    ),
)
