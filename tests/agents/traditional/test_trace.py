"""What the trace of TP tells: contradictions, explanations, why it goes on or ends."""

import pytest

from agents.traditional import TraditionalRobot
from testbed.config import load_config
from testbed.experiment.plan import plan_trials
from testbed.experiment.robots import make_robot
from testbed.experiment.trial import play_trial
from testbed.link import InProcessRobot
from testbed.protocol import Contradiction, Decision
from tests.agents.intentional.lives import BOTH_IN_THE_LIBRARY, WORLD, Wish, live
from tests.literals import parsed

IN_THE_KITCHEN = parsed(["loc(rob1,kitchen)", "loc(book1,kitchen)", "loc(book2,kitchen)"])


def _disturbed(step: int, event: str) -> list[Decision]:
    """Its decisions where this event happens at this step, which it comes to with both books."""
    initial = WORLD.state(IN_THE_KITCHEN)
    calm = live(TraditionalRobot(), initial, BOTH_IN_THE_LIBRARY)
    state, attempt = calm.states[step - 1], calm.decisions[step - 1].action
    possible = [e for e in WORLD.exogenous_actions if WORLD.executable(state, [attempt, e])]
    wishes = {step: Wish(possible.index(event))}
    return list(live(TraditionalRobot(), initial, BOTH_IN_THE_LIBRARY, wishes).decisions)


def test_undisturbed_it_tells_how_much_of_its_plan_is_left() -> None:
    life = live(TraditionalRobot(), WORLD.state(IN_THE_KITCHEN), BOTH_IN_THE_LIBRARY)
    reasons = [decision.trace.reason for decision in life.decisions]
    assert reasons == [
        "a new plan: 7 actions to the goal, none fewer",
        *(f"{left} actions of the plan left" for left in (6, 5, 4, 3, 2)),
        "1 action of the plan left",
        "the plan is over",
    ]
    assert [d.trace.contradictions for d in life.decisions] == [[]] * 8


def test_a_failure_contradicts_what_it_believed_of_its_own_action() -> None:
    decisions = _disturbed(1, "exo_lock(library)")
    told = [d for d in decisions if d.trace.contradictions]
    (decision,) = told
    attempt = "move(rob1,library)"
    assert decision.trace.contradictions == [
        Contradiction(step=2, observed=f"hpd(-{attempt})", believed=f"hpd({attempt})")
    ]
    assert decision.trace.explanation is not None
    assert decision.trace.reason.startswith("a new plan: ")


def test_an_outcome_that_it_sees_contradicts_what_it_believed_of_it() -> None:
    """Book2 is taken away while it comes back, and it reaches for it in vain."""
    decisions = _disturbed(4, "exo_move(book2,office1)")
    (decision,) = (d for d in decisions if d.trace.contradictions)
    (contradiction,) = decision.trace.contradictions
    assert contradiction.observed.startswith("hpd(-pickup(rob1,")
    assert decision.trace.explanation is not None
    assert [e.step for e in decision.trace.explanation.unobserved] == [contradiction.step - 1]


@pytest.mark.parametrize("robot", ["traditional", "traditional-plain"])
def test_a_goal_beyond_the_limit_is_given_up_with_a_reason(robot: str) -> None:
    chosen = ["scenarios=[1]", f"robots=[{robot}]", "link=inprocess", "limits.plan=2"]
    (spec,) = plan_trials(load_config("quickstart", chosen))
    record = play_trial(spec, InProcessRobot(make_robot)).record
    assert (record.outcome, record.no_plan) == ("gave_up", "beyond the limit")
    assert "2" in (record.reason or "")
