"""What functions are confined to: never less than what plans pass through, and no more in a row."""

import random
from collections.abc import Iterator
from functools import partial
from itertools import product
from pathlib import Path

import pytest

from asp.domains import LevelSize
from asp.language import Action, Literal, analyse, functions
from asp.reasoning.fine_planning import FineStart, IncrementalFinePlanner
from asp.reasoning.fine_planning.compact_session import CompactDescription
from asp.reasoning.fine_planning.large.problem_program import in_play, loose
from asp.reasoning.fine_planning.large.relaxed_reachability import Relaxed
from asp.reasoning.fine_planning.large.value_pruning import Functions, confined
from asp.refinement import Refinement, load, load_refinement
from asp.translation import ACTION
from testbed.world import World, world_of
from tests.asp.reasoning.fine_planning.fine_problems import drawn_goal, drawn_state
from tests.asp.refinement.levels import level, of_size
from tests.asp.refinement.locked import locked_texts
from tests.literals import parsed

HERE = Path(__file__).parents[2] / "refinement"
DOMAINS = {
    "tabletop": partial(load_refinement, str(HERE / "tabletop.fine")),
    "assistant": partial(load_refinement, str(HERE / "assistant.fine")),
    "locked": lambda: load(*locked_texts()),
    "L2": partial(level, "L2"),
}

Step = dict[str, set[str]]
"""The functions confined at a step, with the fluents or actions left, in canonical names."""


class Confining:
    """Of a whole description; what it says is in the names of the description.

    `playing` are the constants in play, of what was asked last.
    """

    def __init__(self, refinement: Refinement) -> None:
        source, signature = refinement.weak, refinement.weak_signature
        self._part = CompactDescription(source, signature).part(signature.constants)
        self._relaxed = Relaxed(self._part.program)
        self._known = Functions(self._relaxed, functions(source, signature))
        self.playing: set[str] = set()
        self._loose = loose(self._part.rules, self._part.sorts)

    def steps(self, start: FineStart, goal: tuple[Literal, ...], length: int) -> list[Step] | None:
        """What is left at each step; None where the goal cannot be reached so soon."""
        true, wanted = self._part.seen(start.true), self._part.seen(goal)
        reach = self._relaxed.reach(true, wanted)
        if reach is None or reach.least > length:
            return None
        steps = confined(reach, self._known.number, length)
        playing = in_play(reach, self._known, steps) | self._loose
        self.playing = {c for c, seen in self._part.names.items() if seen in playing}
        return [
            {
                self._part.back([term])[0]: {*self._part.back(self._known.text[n] for n in left)}
                for number, left in step.items()
                for term in self._known.terms[number]
            }
            for step in steps
        ]


def _ways(
    world: World, start: int, goal: tuple[Literal, ...], length: int
) -> Iterator[tuple[int, int, Action | None]]:
    """Each step, state and action of all plans of exactly so many actions."""
    layers: list[dict[int, list[tuple[Action, int]]]] = []
    states = {start}
    for _ in range(length):
        layers.append({state: list(_transitions(world, state)) for state in states})
        states = {after for moves in layers[-1].values() for _, after in moves}
    good = {state for state in states if world.satisfies(state, goal)}
    yield from ((length, state, None) for state in good)
    for step in range(length - 1, -1, -1):
        leading = [
            (state, action)
            for state, moves in layers[step].items()
            for action, after in moves
            if after in good
        ]
        yield from ((step, state, action) for state, action in leading)
        good = {state for state, _ in leading}


def _transitions(world: World, state: int) -> Iterator[tuple[Action, int]]:
    for action in world.agent_actions:
        yield from ((action, after) for after in world.successors(state, [action]))


@pytest.mark.parametrize("name", DOMAINS)
def test_every_plan_keeps_to_what_is_left(name: str) -> None:
    refinement = DOMAINS[name]()
    draw, confining = random.Random(41), Confining(refinement)
    world = world_of(refinement)
    passed = 0
    for _, length in product(range(15), (1, 2, 3)):
        start, goal = drawn_state(refinement, draw), drawn_goal(refinement, draw)
        steps = confining.steps(start, goal, length)
        for step, state, action in _ways(world, world.state(start.true), goal, length):
            assert steps is not None
            true = {*world.true_atoms(state)}
            for function, left in steps[step].items():
                assert action in left if function == ACTION else not left.isdisjoint(true)
            named = {c for said in [*true, *filter(None, [action])] for c in said.arguments}
            assert named <= confining.playing
            passed += 1
    assert passed


ROW = partial(of_size, LevelSize(2, 1, 3, ((1, 2),)))


def _places(thing: str, *cells: str) -> set[str]:
    return {f"fine_loc({thing},{cell})" for cell in cells}


def test_in_a_row_every_step_has_one_place() -> None:
    confining, start = Confining(ROW()), FineStart(frozenset(parsed(["fine_loc(rob1,room1_1)"])))
    steps = confining.steps(start, parsed(["loc(rob1,room2)"]), 3)
    assert steps is not None
    cells = ("room1_1", "room1_2", "room1_3", "room2_1")
    assert [step["fine_loc(rob1)"] for step in steps] == [_places("rob1", cell) for cell in cells]
    moves = [{f"fine_move(rob1,{cell})"} for cell in cells[1:]]
    assert [step[ACTION] for step in steps[:-1]] == moves
    assert not confining.playing & {"room2_2", "room2_3"}


def test_with_a_step_to_spare_there_is_more() -> None:
    start = FineStart(frozenset(parsed(["fine_loc(rob1,room1_1)"])))
    steps = Confining(ROW()).steps(start, parsed(["loc(rob1,room2)"]), 4)
    assert steps is not None
    assert steps[2]["fine_loc(rob1)"] == _places("rob1", "room1_2", "room1_3")


def test_what_is_held_is_where_the_robot_is() -> None:
    held = {"fine_in_hand(rob1,object1_1)"}
    true = held.union(*(_places(t, "room1_2") for t in ("rob1", "object1_1", "object1_2")))
    steps = Confining(ROW()).steps(
        FineStart(frozenset(parsed(true))), parsed(["loc(rob1,room2)", "loc(object1,room2)"]), 2
    )
    assert steps is not None
    assert steps[1]["fine_in_hand(rob1)"] == held
    assert steps[1]["fine_loc(object1_1)"] >= _places("object1_1", "room1_3")
    assert not steps[1]["fine_loc(object1_1)"] & _places("object1_1", "room1_2", "room2_1")


def test_where_the_goal_holds_already_one_may_go_elsewhere_and_come_back() -> None:
    start = FineStart(frozenset(parsed(["fine_loc(rob1,room2_1)"])))
    steps = Confining(ROW()).steps(start, parsed(["loc(rob1,room2)"]), 2)
    assert steps is not None
    anywhere = _places("rob1", "room1_3", "room2_1", "room2_2")
    assert steps[1].get("fine_loc(rob1)", anywhere) >= anywhere


MARKED = """
sorts
  robot = {rob1}.
  spot  = {spot1, spot2, spot3}.
statics
  wet(spot).
fluents
  inertial swept(spot).
  inertial glad(robot).
actions
  agent sweep(robot, spot).
  agent sing(robot).
laws
  sweep(R, S) causes swept(S).
  sing(R) causes glad(R).
  impossible sing(R) if wet(S), -swept(S).
facts
  wet(spot2).
"""


def test_what_a_law_speaks_of_without_naming_it_otherwise_stays_in_play() -> None:
    source, signature = analyse(MARKED)
    part = CompactDescription(source, signature).part(signature.constants)
    kept = loose(part.rules, part.sorts)
    assert {part.names[f"spot{n}"] for n in (1, 2, 3)} <= kept
    planner = IncrementalFinePlanner(source, signature, largest=-1)
    plan = planner.plan(FineStart(frozenset()), parsed(["glad(rob1)"]), 3)
    assert plan == ("sweep(rob1,spot2)", "sing(rob1)")
