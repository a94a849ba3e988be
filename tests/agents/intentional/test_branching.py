"""Where actions have several outcomes: both ways of reasoning agree, and the robot recovers."""

import pytest
from hypothesis import assume, event, given, settings
from hypothesis import strategies as st

from agents.intentional import IntentionalRobot
from agents.intentional.activities import History
from agents.intentional.controller import Reference
from agents.intentional.joint import Joint, StagedJoint
from agents.intentional.reasoners import IncrementalReasoner, ReferenceReasoner
from agents.shared import MakeReasoner
from agents.traditional import TraditionalRobot
from agents.traditional.robot import TraditionalReference
from asp import parse_description
from asp.language import Description
from testbed.protocol import Plans, RobotStops
from testbed.world import world_of
from tests.agents.both_ways import EARLY, both_ways
from tests.agents.intentional.branching_lives import live
from tests.asp.reasoning.branching import DEFINED, DIE, DOOR, INERTIAL, descriptions
from tests.literals import parsed

SHOWN = """shows
  throw shows up(F).
  throw shows thrown.
"""
PLANS = ("optimistic", "conformant")
FLUENTS = (*INERTIAL, *DEFINED)
BOTH = both_ways(IncrementalReasoner, ReferenceReasoner)
BOTH_COMPRESSED = both_ways(IncrementalReasoner, ReferenceReasoner, EARLY)


@pytest.mark.parametrize("plans", PLANS)
@settings(max_examples=40)
@given(
    description=descriptions(),
    goal=st.lists(
        st.builds("{}{}".format, st.sampled_from(["", "-"]), st.sampled_from(FLUENTS)),
        min_size=1,
        max_size=2,
        unique_by=lambda literal: literal.strip("-"),
    ),
    seen=st.sets(st.sampled_from(FLUENTS)),
    known=st.none() | st.sets(st.sampled_from(FLUENTS)),
    events=st.booleans(),
    reasoner=st.sampled_from([BOTH, BOTH_COMPRESSED]),
    draw=st.data(),
    seed=st.integers(0, 99),
)
def test_every_decision_of_a_life_is_the_same(
    plans: Plans,
    description: Description,
    goal: list[str],
    seen: set[str],
    known: set[str] | None,
    events: bool,
    reasoner: MakeReasoner[History],
    draw: st.DataObject,
    seed: int,
) -> None:
    states = list(world_of(description).states())
    assume(states)
    initial = draw.draw(st.sampled_from(states))
    robot = IntentionalRobot(reasoner)
    try:
        life = live(
            robot,
            description,
            initial,
            goal,
            plans=plans,
            seen=seen,
            known=known,
            events=events,
            seed=seed,
        )
    except RobotStops:
        event("inconsistent")
        return
    event(f"actions: {len(life.actions)}")


def _initial(text: str, *true: str) -> tuple[Description, int]:
    description = parse_description(text, "own.al")
    return description, world_of(description).state(parsed(true))


@pytest.mark.parametrize("seed", range(6))
def test_a_die_is_thrown_until_the_face_is_up_and_every_other_face_is_explained(seed: int) -> None:
    description, initial = _initial(DIE, "up(one)", "thrown")
    life = live(
        IntentionalRobot(), description, initial, ["up(two)", "thrown"], seed=seed, steps=60
    )
    world = world_of(description)
    assert world.satisfies(life.states[-1], parsed(["up(two)", "thrown"]))
    throws = [d.step for d in life.decisions if d.action == "throw"]
    assert life.actions == ["grab", "throw"] * len(throws)
    explained = {d.step: d.trace.explanation for d in life.decisions if d.trace.explanation}
    assert [*explained] == [step + 1 for step in throws[:-1]]
    for step, explanation in explained.items():
        (outcome,) = explanation.outcomes
        assert (outcome.step, outcome.action) == (step - 1, "throw")
        assert not explanation.unobserved


def test_seeds_lead_to_several_numbers_of_throws() -> None:
    description, initial = _initial(DIE, "up(one)", "thrown")
    lives = (
        live(IntentionalRobot(), description, initial, ["up(two)", "thrown"], seed=seed, steps=60)
        for seed in range(6)
    )
    assert len({len(life.actions) for life in lives}) > 1


def _stuck() -> int:
    """A seed with which the door sticks at first."""
    description, initial = _initial(DOOR, "shut", "loose")
    for seed in range(9):
        life = live(IntentionalRobot(), description, initial, ["outside"], seed=seed)
        if "let_go" in life.actions:
            return seed
    raise AssertionError("with some seed the door sticks")


@pytest.mark.parametrize("kind", [IntentionalRobot, Reference, Joint, StagedJoint])
def test_a_door_that_sticks_is_let_go_oiled_and_pulled_again(kind: type[IntentionalRobot]) -> None:
    description, initial = _initial(DOOR, "shut", "loose")
    life = live(kind(), description, initial, ["outside"], seed=_stuck(), steps=40)
    assert life.actions[:4] == ["pull", "let_go", "oil", "pull"]
    assert life.actions[-1] == "leave"
    assert world_of(description).satisfies(life.states[-1], parsed(["outside"]))


def test_the_reason_and_the_contradiction_are_about_the_outcome() -> None:
    description, initial = _initial(DOOR, "shut", "loose")
    life = live(IntentionalRobot(), description, initial, ["outside"], seed=_stuck())
    (told,) = (d for d in life.decisions[:4] if d.trace.explanation is not None)
    assert told.trace.mental == "stop(1)"
    assert "pull at step 2" in told.trace.reason
    contradictions = [(each.step, each.observed) for each in told.trace.contradictions]
    assert contradictions == [(3, "shut"), (3, "-loose")]


@pytest.mark.parametrize(
    ("true", "goal", "plan", "several"),
    [
        (("shut",), "loose", ["oil"], False),
        (("shut",), "pulled", ["pull"], False),
        (("shut", "loose"), "pulled", ["pull"], True),
        (("shut", "loose"), "outside", ["pull", "leave"], True),
        (("loose", "pulled"), "outside", ["leave"], False),
    ],
)
def test_some_outcomes_are_told_of_plans_with_an_action_that_has_several(
    true: tuple[str, ...], goal: str, plan: list[str], several: bool
) -> None:
    description, initial = _initial(DOOR, *true)
    trace = live(IntentionalRobot(), description, initial, [goal]).decisions[0].trace
    assert trace.plan == plan
    assert ("some" in trace.reason.split()) == several
    life = live(IntentionalRobot(), description, initial, [goal], plans="conformant")
    if life.actions:  # with some outcomes fewer actions may do
        assert "all" in life.decisions[0].trace.reason.split()


@pytest.mark.parametrize("kind", [IntentionalRobot, Reference])
def test_an_outcome_that_was_not_seen_is_explained_when_it_is(kind: type[IntentionalRobot]) -> None:
    """Who throws without a look believes in success until told that there is none."""
    description, initial = _initial(DIE, "up(one)", "up(two)", "up(three)")
    lives = (
        live(kind(), description, initial, ["up(two)", "thrown"], seen=["thrown"], seed=seed)
        for seed in range(9)
    )
    life = next(life for life in lives if len(life.actions) > 1)
    assert life.actions[:3] == ["throw", "grab", "throw"]
    assert life.decisions[2].action == "finish"
    explanation = life.decisions[3].trace.explanation
    assert explanation is not None
    assert [(o.step, o.action) for o in explanation.outcomes] == [(2, "throw")]


def test_an_attempt_that_fails_shows_an_outcome_that_was_not_seen() -> None:
    description, initial = _initial(DOOR, "shut", "loose")
    life = live(IntentionalRobot(), description, initial, ["outside"], seen=[], seed=_stuck())
    assert life.actions[:4] == ["pull", "leave", "let_go", "oil"]
    told = life.decisions[3]
    assert told.trace.mental == "stop(1)"
    assert told.trace.explanation is not None
    assert [(o.step, o.action) for o in told.trace.explanation.outcomes] == [(2, "pull")]
    assert not told.trace.explanation.unobserved
    assert [each.observed for each in told.trace.contradictions] == ["hpd(-leave)"]


def test_a_conformant_robot_does_not_throw_and_gives_up() -> None:
    description, initial = _initial(DIE, "up(one)", "up(two)", "up(three)")
    goal = ["up(two)", "-up(one)"]
    life = live(IntentionalRobot(), description, initial, goal, plans="conformant")
    assert not life.actions
    assert live(IntentionalRobot(), description, initial, goal).actions


@pytest.mark.parametrize("kind", [TraditionalRobot, TraditionalReference])
def test_the_baseline_plans_anew_where_the_outcome_is_another(kind: type[TraditionalRobot]) -> None:
    description, initial = _initial(DIE + SHOWN, "up(one)", "thrown")
    for seed in range(6):
        life = live(kind(), description, initial, ["up(two)", "thrown"], seed=seed, steps=60)
        assert world_of(description).satisfies(life.states[-1], parsed(["up(two)", "thrown"]))


def test_a_conformant_robot_knows_of_no_longer_plan() -> None:
    description, initial = _initial(DIE, "up(one)", "up(two)", "up(three)")
    life = live(
        IntentionalRobot(), description, initial, ["up(two)", "-up(one)"], plans="conformant"
    )
    assert life.decisions[0].action == "finish"
    assert life.decisions[0].trace.no_plan == "not known"
