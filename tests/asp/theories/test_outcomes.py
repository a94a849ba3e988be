"""Intentions where an action has several outcomes: which is preferred, and by which paragraph."""

import clingo

from asp.reasoning import knowledge
from asp.solving import fact, first_model, ground, select
from asp.translation import translate
from tests.asp.reasoning.stories import activity, did, intending, lines, theories_for
from tests.asp.theories.axioms import lettered, theory_text

# Of two lamps one goes out when the switch is thrown, and which is open.
LAMPS = """
fluents
  inertial red.
  inertial green.
  inertial thrown.
actions
  agent throw.
  agent reset.
  agent smash.
laws
  throw causes thrown.
  reset causes -thrown.
  reset causes red.
  reset causes green.
  smash causes -green.
  -red   if green, thrown.
  -green if red, thrown.
  impossible throw if thrown.
"""
FLUENTS = ("red", "green", "thrown")
ACTIONS = ("throw", "reset", "smash")
SELECTED = "hpd(select(my_goal),true,0)."
BOTH_ON = "holds(red,0). holds(green,0). -holds(thrown,0)."


def _control(rules: str, n: int, against: str | None) -> clingo.Control:
    ranks = [fact("ranks", 3), *(fact("rank", a, i) for i, a in enumerate(ACTIONS))]
    ranks += [fact("fluent_rank", fluent, n) for n, fluent in enumerate(FLUENTS)]
    theories = [theory_text(name) for name in (*theories_for("planning"), "goal_persistence")]
    if against is not None:
        said = lettered("planning")[against].text
        turned = said.replace(", true]", ", TRUE]").replace(", false]", ", true]")
        turned = turned.replace(", TRUE]", ", false]")
        assert turned != said
        theories = [text.replace(said, turned) for text in theories]
    constants = {"n": n, "max_name": 2, "max_len": 3}
    return ground([translate(LAMPS, "lamps.al"), *theories, rules], constants, ranks)


def _said(rules: str, n: int, against: str | None = None) -> tuple[str, set[str]]:
    model = first_model(_control(rules, n, against))
    assert model is not None
    ((action, _),) = select(model, "intended_action", 2)
    believed = {str(fluent) for (fluent,) in select(model, "believed", 1)}
    return str(action), believed


GREEN_OUT = "goal(green,false)."


def _story(goal: str, plan: tuple[str, ...], done: int) -> str:
    """An activity with a plan of which some actions were done, while nothing was seen."""
    acted = (did(step, action) for step, action in enumerate(plan[:done], start=2))
    started = lines(BOTH_ON, SELECTED, did(1, "start(1)"), activity(1, *plan))
    return lines(started, goal, *acted, intending(2 + done))


def test_an_activity_that_may_succeed_is_not_futile() -> None:
    story = _story(GREEN_OUT, ("throw",), 0)
    assert _said(story, 3)[0] == "throw"
    assert _said(story, 3, against="planning.a")[0] == "stop(1)"


def test_who_may_be_done_finishes_and_believes_it() -> None:
    story = _story(GREEN_OUT, ("throw",), 1)
    assert _said(story, 4) == ("finish", {"red", "thrown", "my_goal"})
    assert _said(story, 4, against="planning.a")[0] == "stop(1)"


def test_who_may_go_on_does_not_finish() -> None:
    story = _story(GREEN_OUT, ("throw", "smash"), 1)
    assert _said(story, 5)[0] == "smash"
    assert _said(story, 5, against="planning.a")[0] != "smash"


def test_who_has_no_activity_finishes_rather_than_starts_one() -> None:
    stopped = lines(did(3, "stop(1)"), intending(4))
    story = _story(GREEN_OUT, ("throw", "reset"), 1).replace(intending(3), stopped)
    assert _said(story, 6)[0] == "finish"
    assert _said(story, 6, against="planning.a")[0] == "start(2)"


def test_of_several_states_the_first_in_the_order_of_fluents_is_believed() -> None:
    story = _story("goal(thrown,false).", ("throw",), 1)
    assert _said(story, 4) == ("stop(1)", {"red", "thrown"})
    assert _said(story, 4, against="planning.b") == ("stop(1)", {"green", "thrown"})


def test_of_the_activity_as_much_as_may_be_is_done() -> None:
    """Where the goal held for a while the next action was no step of the activity."""
    story = _story(GREEN_OUT, ("throw", "reset", "smash"), 2)
    assert _said(story, 7)[0] == "smash"
    assert _said(story, 7, against="planning.b")[0] == "reset"


# A window that is stuck does not open, and no law says that it is impossible to open it.
WINDOW = """
fluents
  inertial wide.
  inertial stuck.
  inertial clean.
actions
  agent wipe.
  agent open.
laws
  wipe causes clean.
  open causes wide.
  -wide if stuck.
"""


def _with_a_stuck_window(program: str, without: str = "") -> str | None:
    """What is intended with the plan wipe, open while the window is stuck."""
    stuck = "-holds(wide,0). holds(stuck,0). -holds(clean,0). goal(wide,true). goal(clean,true)."
    started = lines(stuck, SELECTED, did(1, "start(1)"), activity(1, "wipe", "open"), intending(2))
    theories = [theory_text(name) for name in (*theories_for("planning"), "goal_persistence")]
    ranks = [fact("ranks", 2), fact("rank", "wipe", 0), fact("rank", "open", 1)]
    texts = [program, *theories, started]
    texts = [text.replace(without, "") for text in texts] if without else texts
    model = first_model(ground(texts, {"n": 5, "max_name": 2, "max_len": 2}, ranks))
    return None if model is None else str(select(model, "intended_action", 2)[0][0])


def test_an_activity_is_given_up_at_the_action_that_no_state_can_follow() -> None:
    program = knowledge("window", WINDOW).program
    assert _with_a_stuck_window(program) == "stop(1)"
    assert _with_a_stuck_window(program, ", not disqualified(AA,I1)") is None  # (35)
    assert _with_a_stuck_window(translate(WINDOW, "window.al")) is None
