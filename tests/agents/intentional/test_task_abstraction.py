"""A robot decides the same without the constants that its goal does not need."""

from collections.abc import Sequence
from dataclasses import replace

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from msgspec import structs

from agents.intentional import IntentionalRobot
from agents.intentional.abstraction import AbstractTask
from asp.domains import level_text
from asp.language import Literal, parse_description
from testbed.protocol import Decision, Event, Percept, Task
from testbed.world import world_of
from tests.agents.intentional.lives import OFFICE, Place, Wish, live
from tests.literals import parsed

SOURCE = level_text(3, 1, 2, ((4, 1),))[0]
WORLD = world_of(parse_description(SOURCE, "level.al"))
PLACE = Place("level", WORLD, SOURCE)
STATES = list(WORLD.initial_states())
GOALS = [
    literal
    for fluent in WORLD.fluents
    if "object" in fluent
    for literal in (fluent, fluent.complement)
]
Assumed = tuple[list[Event], list[Event]]
"""Events that nobody reported, and reports that are distrusted."""

WISHES = st.dictionaries(
    st.integers(1, 12), st.builds(Wish, st.integers(0, 60), st.booleans()), max_size=2
)


class AbstractingRobot:
    """Plays a task as the intentional robot plays what is left of it."""

    def begin(self, task: Task) -> None:
        self._robot, self._abstract = IntentionalRobot(), AbstractTask(task)
        self._robot.begin(self._abstract.task)

    def act(self, percept: Percept) -> Decision:
        return self._abstract.decision(self._robot.act(self._abstract.percept(percept)))


@given(st.sampled_from(STATES), st.lists(st.sampled_from(GOALS), min_size=1, max_size=2), WISHES)
@settings(max_examples=60)
def test_decisions_are_those_of_the_whole_task(
    initial: int, goal: list[str], wishes: dict[int, Wish]
) -> None:
    whole = live(IntentionalRobot(), initial, goal, wishes, steps=20, where=PLACE)
    abstracting = live(AbstractingRobot(), initial, goal, wishes, steps=20, where=PLACE)
    assert [_shown(d) for d in abstracting.decisions] == [_shown(d) for d in whole.decisions]
    abstract = AbstractTask(_task(goal, [*WORLD.true_atoms(initial)]))
    assert _explained(abstracting.decisions, abstract) == _explained(whole.decisions, abstract)


def _shown(decision: Decision) -> tuple[object, ...]:
    trace = decision.trace
    return (decision.action, decision.believes_goal, trace.mental, trace.plan, trace.futile_at)


def _explained(decisions: Sequence[Decision], abstract: AbstractTask) -> list[Assumed]:
    """What is assumed at each step, as far as it is about what is left of the task.

    Only the whole robot has to explain the news of things that are left out.
    """
    held: Assumed = [], []
    found = []
    for decision in decisions:
        explanation = decision.trace.explanation
        if explanation is not None:
            held = (
                [event for event in explanation.unobserved if abstract.is_about(event.action)],
                [report for report in explanation.distrusted if abstract.is_about(report.action)],
            )
        found.append(held)
    return found


def _task(goal: list[str], true: list[str], place: Place = PLACE) -> Task:
    state = place.world.state(true)
    return Task(
        trial="t",
        robot="r",
        domain=place.domain,
        source=place.source,
        goal=goal,
        initial=list(place.world.literals(state)),
        plan_limit=20,
        seed=0,
    )


AT_HOME = parsed(
    [f"loc({thing},room1)" for thing in ("rob1", "object1", "object2", "object3", "object4")]
)


def test_what_the_goal_does_not_name_is_left_out() -> None:
    abstract = AbstractTask(_task(parsed(["loc(object3,room2)"]), AT_HOME))
    assert abstract.task.goal == ["loc(object1,room2)"]
    assert parse_description(abstract.task.source).sorts["object"] == ("object1",)
    assert abstract.back(parsed(["pickup(rob1,object1)"])) == ["pickup(rob1,object3)"]


def test_what_the_robot_holds_is_kept() -> None:
    abstract = AbstractTask(
        _task(parsed(["loc(object3,room2)"]), [*AT_HOME, "in_hand(rob1,object4)"])
    )
    assert abstract.seen(
        parsed(["loc(object3,room1)", "loc(object4,room1)", "loc(object1,room1)"])
    ) == ["loc(object1,room1)", "loc(object2,room1)"]


def test_what_may_be_in_the_hand_is_kept() -> None:
    task = _task(parsed(["loc(object3,room2)"]), AT_HOME)
    known = [literal for literal in task.initial if "in_hand(rob1,object2)" not in literal]
    abstract = AbstractTask(structs.replace(task, initial=known))
    assert abstract.is_about(Literal.parse("loc(object2,room1)"))
    assert not abstract.is_about(Literal.parse("loc(object1,room1)"))


def test_tasks_that_differ_in_names_are_one() -> None:
    one = AbstractTask(_task(parsed(["loc(object2,room2)"]), AT_HOME)).task
    other = AbstractTask(_task(parsed(["loc(object4,room2)"]), AT_HOME)).task
    assert one == other


def test_nothing_is_left_out_where_others_can_put_it_in_the_way() -> None:
    source = SOURCE + "\nactions\n  exogenous hand_over(robot, object).\n"
    source += "laws\n  hand_over(R, O) causes in_hand(R, O).\n"
    place = replace(PLACE, source=source, world=world_of(parse_description(source, "more.al")))
    abstract = AbstractTask(_task(parsed(["loc(object3,room2)"]), AT_HOME, place))
    assert abstract.task.source == source


@pytest.mark.parametrize("goal", parsed(["loc(book1,library)", "in_hand(rob1,book2)"]))
def test_scenarios_and_costs_are_no_part_of_what_is_left(goal: str) -> None:
    task = _task(
        [goal], parsed(["loc(rob1,kitchen)", "loc(book1,office1)", "loc(book2,office1)"]), OFFICE
    )
    assert "scenarios" in task.source
    assert "scenarios" not in AbstractTask(task).task.source
