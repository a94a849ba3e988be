"""Cases for (42)-(53): a new plan, or an earlier one again, and having an intention."""

from tests.asp.reasoning.stories import (
    GATE_OPEN,
    GATE_SHUT,
    GOAL,
    SELECTED,
    STARTED,
    STOPPED,
    Case,
    activity,
    intending,
    lines,
)
from tests.asp.theories.axioms import Always, Inconsistent, never, possible

_OPEN = lines(GATE_OPEN, GOAL)
_SHUT = lines(GATE_SHUT, GOAL)
# The goal was just selected; a plan is looked for at step 1.
_PLANNING = lines(_OPEN, SELECTED, intending(1))
# The plan to cross was just started; its first action is due at step 2.
_CROSSING = lines(_OPEN, STARTED, activity(1, "go(right)"), intending(2))
# The plan was stopped before its first action, and nothing but that plan helps.
_AGAIN = lines(_OPEN, STOPPED, activity(1, "go(right)"), intending(3))

CASES = (
    Case(
        42,
        "the candidate for a goal just selected has the next available name",
        _PLANNING,
        Always("candidate(1,1)"),
        n=3,
        rule=7,
    ),
    *(
        Case(
            42,
            "an earlier activity is started again where its very plan is needed",
            _AGAIN,
            Always("intended_action(start(1),3)"),
            n=5,
            rule=rule,
        )
        for rule in (1, 2, 6)
    ),
    Case(
        42,
        "an activity that is started again takes up no new name",
        _AGAIN,
        never("candidate(2,3)"),
        n=5,
        rule=3,
    ),
    Case(
        42,
        "an earlier activity is not started again for the first actions of its plan alone",
        lines(_OPEN, STOPPED, activity(1, "go(right)", "switch_on"), intending(3)),
        never("intended_action(start(1),3)"),
        n=5,
        rule=4,
    ),
    Case(
        42,
        "nor where its plan is only the beginning of the one that is needed",
        lines(_SHUT, STOPPED, activity(1, "open"), intending(3)),
        never("intended_action(start(1),3)"),
        n=6,
        rule=5,
    ),
    Case(
        43,
        "the candidate is for the goal without activity",
        _PLANNING,
        Always("activity_goal(1,my_goal)"),
        n=3,
    ),
    Case(
        44,
        "of two candidates one is started",
        lines(_PLANNING, "candidate(2,1)."),
        possible("intended_action(start(1),1)"),
        n=3,
    ),
    Case(45, "the candidate is started", _PLANNING, Always("occurs(start(1),1)"), n=3),
    Case(
        46,
        "an action occurs at the step at which the candidate is started",
        _PLANNING,
        Always("some_action_occurred(1)"),
        n=3,
    ),
    Case(
        47,
        "physical actions are found that lead to the goal",
        _PLANNING,
        Always("occurs(go(right),2)"),
        n=3,
    ),
    Case(
        48,
        "they are the components of the candidate",
        _PLANNING,
        Always("activity_component(1,1,go(right))"),
        n=3,
    ),
    Case(
        49,
        "a plan has no two actions at one index",
        lines(_PLANNING, "goal(lit,true)."),
        Inconsistent(),
        n=3,
    ),
    Case(
        50,
        "the candidate has a component at each index of its plan",
        lines(_SHUT, SELECTED, intending(1)),
        Always("has_component(1,2)"),
        n=4,
    ),
    Case(
        51,
        "its length is that of its plan",
        lines(_SHUT, SELECTED, intending(1)),
        Always("activity_length(1,2)"),
        n=4,
    ),
    Case(
        52,
        "the robot intends to start the candidate",
        _PLANNING,
        Always("intended_action(start(1),1)"),
        n=3,
    ),
    Case(
        53, "a robot with an intention has one", _CROSSING, Always("has_intention(2)"), n=3, rule=1
    ),
    Case(
        53,
        "without a plan within the horizon there is no answer set",
        lines(_SHUT, SELECTED, intending(1)),
        Inconsistent(),
        n=3,
        rule=2,
    ),
    Case(
        53,
        "where no plan within the limit exists the robot finishes",
        lines(_SHUT, SELECTED, intending(1), "beyond_limit."),
        Always("intended_action(finish,1)"),
        n=3,
        rule=3,
    ),
)
