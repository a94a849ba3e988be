"""TI: one program for diagnosis and planning, with every smallest explanation considered."""

from itertools import product
from pathlib import Path

import pytest

from agents.intentional import IntentionalRobot
from agents.intentional.activities import Activity, History
from agents.intentional.joint import JointReasoner, StagedJointReasoner
from agents.intentional.reasoners import ReferenceReasoner
from agents.shared import Intention
from asp.language import Literal
from asp.reasoning import knowledge
from asp.reasoning.diagnosis import SELECT, Diagnosis, Explanation, Happening
from testbed.config import load_config
from testbed.experiment.runner import play_missing
from testbed.experiment.store import read_records
from tests.agents.intentional.lives import DOMAIN, SOURCE, WORLD, Wish, live
from tests.agents.intentional.test_joint_lives import BesideAti
from tests.literals import parsed

OFFICE = knowledge(DOMAIN, SOURCE)


class Unique(BesideAti):
    """Also insists that activities are unique (28)."""

    def intend(self, history: History, explained: Diagnosis) -> Intention:
        plans = [activity.plan for activity in history.activities]
        assert len(plans) == len(set(plans))
        return super().intend(history, explained)


@pytest.mark.parametrize(
    "wishes", [{2: Wish(0)}, {2: Wish(4)}, {1: Wish(5), 3: Wish(3)}, {3: Wish(1)}]
)
def test_its_explanations_are_as_small_as_those_of_ati(wishes: dict[int, Wish]) -> None:
    initial = WORLD.state(parsed(["loc(rob1,office2)", "loc(book1,kitchen)", "loc(book2,kitchen)"]))
    life = live(IntentionalRobot(Unique), initial, parsed(["loc(book2,library)"]), wishes)
    assert life.achieved


def test_it_achieves_the_six_published_scenarios(tmp_path: Path) -> None:
    """To the letter and in two stages."""
    robots = ("intentional-joint", "intentional-joint-staged")
    given = ["link=inprocess", f"robots=[{','.join(robots)}]", "limits.plan=12"]
    given.append("limits.decision_s=null")
    play_missing(load_config("quickstart", given), tmp_path, 1, lambda _: None)
    outcomes = {(r.scenario, r.robot): r.outcome for r in read_records(tmp_path)}
    assert outcomes == dict.fromkeys(product("123456", robots), "achieved")


def test_of_all_explanations_the_one_with_the_shortest_plan_counts() -> None:
    """Book2 is gone from the kitchen, to a room next to it or to the one beyond."""
    history = History(step=3)
    start = WORLD.state(parsed(["loc(rob1,kitchen)", "loc(book1,kitchen)", "loc(book2,kitchen)"]))
    history.observe(WORLD.literals(start), 0)
    history.happened(SELECT, True, 0)
    history.activities.append(Activity(1, parsed(["pickup(rob1,book2)"])))
    for step, mental in ((1, "start(1)"), (2, "stop(1)")):
        history.attempt(mental, step)
        history.happened(mental, True, step)
    history.observe(parsed(["-loc(book2,kitchen)"]), 2)
    goal = parsed(["in_hand(rob1,book2)"])

    def planned(room: str) -> int:
        event = Happening(1, Literal.parse(f"exo_move(book2,{room})"))
        explained = Diagnosis(Explanation(unobserved=(event,)))
        return len(ReferenceReasoner(OFFICE, goal, 9).intend(history, explained).plan)

    assert (planned("library"), planned("office2"), planned("office1")) == (2, 2, 3)
    for room in ("office1", "office2", "library"):
        event = Happening(1, Literal.parse(f"exo_move(book2,{room})"))
        first = Diagnosis(Explanation(unobserved=(event,)))
        intention = StagedJointReasoner(OFFICE, goal, 9).intend(history, first)
        assert (intention.action, len(intention.plan)) == ("start(2)", 2)
        assert intention.under is not None
        assert intention.under.explanation.size == 1


LAMP = """
sorts
  robot = {rob}.
fluents
  inertial lit.
  inertial here(robot).
actions
  agent     leave(robot).
  exogenous switch_on.
  exogenous strike.
laws
  leave(R) causes -here(R).
  switch_on causes lit.
  strike    causes lit.
"""


def test_an_explanation_that_news_makes_needless_is_not_kept() -> None:
    """Neither by ATI, which keeps an explanation while none is smaller, nor by TI."""
    goal = parsed(["-here(rob)"])
    sizes = dict[type[ReferenceReasoner], list[int]]()
    for make in (ReferenceReasoner, StagedJointReasoner):
        reasoner = make(knowledge("lamp", LAMP), goal, 3)
        history = History(step=3)
        history.observe(parsed(["-lit", "here(rob)"]), 0)
        history.happened(SELECT, True, 0)
        history.observe(parsed(["lit"]), 3)
        first = reasoner.diagnose(history, Explanation()).explanation
        history.happened(Literal.parse("strike"), True, 1)
        second = reasoner.diagnose(history, first).explanation
        sizes[make] = [first.size, second.size]
    assert sizes == {ReferenceReasoner: [1, 0], StagedJointReasoner: [1, 0]}


NOISE = """
sorts
  robot = {rob}.
fluents
  inertial lit.
  inertial noise.
actions
  agent     light(robot).
  exogenous strike.
  exogenous bang.
laws
  light(R) causes lit.
  strike   causes lit.
  strike   causes noise.
  bang     causes noise.
"""


@pytest.mark.parametrize("make", [StagedJointReasoner, JointReasoner])
def test_it_goes_on_where_some_smallest_explanation_lets_it(make: type[ReferenceReasoner]) -> None:
    """There was a noise: with or without light, which is the goal."""
    reasoner = make(knowledge("noise", NOISE), parsed(["lit"]), 3)
    history = History(step=2)
    history.observe(parsed(["-lit", "-noise"]), 0)
    history.happened(SELECT, True, 0)
    history.activities.append(Activity(1, parsed(["light(rob)"])))
    history.attempt(Literal.parse("start(1)"), 1)
    history.happened(Literal.parse("start(1)"), True, 1)
    history.observe(parsed(["noise"]), 2)
    intention = reasoner.intend(history, reasoner.diagnose(history, Explanation()))
    assert intention.action == "light(rob)"
    assert intention.under is not None
    assert intention.under.explanation.unobserved == ((1, "bang"),)
