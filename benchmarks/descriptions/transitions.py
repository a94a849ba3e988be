"""The program, both worlds, both planners and derived conditions, against the definition."""

from collections.abc import Iterable, Iterator
from dataclasses import replace
from itertools import product

from asp.language import Literal, analyse
from asp.reasoning.planning import ReferencePlanner
from asp.reasoning.qualifications import qualifications
from asp.translation import translate
from benchmarks.descriptions.case import FILE, Case, agree
from benchmarks.descriptions.definition import State
from benchmarks.descriptions.drawing import random_goal
from benchmarks.descriptions.signatures import ROBOT
from testbed.world import World, world_of

_STATES, _COMPOUNDS, _PLANS = 6, 8, 4
_LONGEST_REFERENCE, _LONGEST_CONFORMANT = 4, 5


def check_diagram(case: Case) -> None:
    """States, initial ones, what is visible, and the successors of single and compound actions."""
    known, domain = case.definition, case.domain
    ground, matched = world_of(domain.description), world_of(analyse(case.description.text)[0])
    worlds = {"compiled": ground, "matched": matched}
    agree("fluents", definition=known.fluents, **{n: w.fluents for n, w in worlds.items()})
    agree(
        "states",
        definition={*known.states},
        program={*domain.diagram().states},
        **{name: _sets(world, world.states()) for name, world in worlds.items()},
    )
    agree(
        "initial states",
        definition={*known.initial},
        **{name: _sets(world, world.initial_states()) for name, world in worlds.items()},
    )
    inertial = {state & {*known.inertial} for state in known.states}
    agree("what is defined follows", states=len(known.states), inertial=len(inertial))
    for state in case.some_states(_STATES):
        numbers = {name: _number(world, state) for name, world in worlds.items()}
        agree(
            f"visible in {sorted(state)}",
            definition=known.visible(state),
            **{n: frozenset(w.visible(numbers[n], ROBOT)) for n, w in worlds.items()},
        )
        for actions in _compounds(case):
            agree(
                f"after {sorted(actions)} in {sorted(state)}",
                definition=known.after(state, actions),
                program={*domain.outcomes(_parsed(state), _parsed(actions))},
                **{
                    name: _sets(world, world.successors(numbers[name], _parsed(actions)))
                    for name, world in worlds.items()
                },
            )


def check_qualifications(case: Case) -> None:
    """Where an action of the agent's has no successor, and where a law or a condition says so.

    Also if no statement names a constant, so that many actions are alike.
    """
    for each in case, replace(case, description=case.description.schematic):
        if each.is_of_the_language:
            _check_qualifications(each)


def _check_qualifications(case: Case) -> None:
    known, domain = case.definition, case.domain
    found = list(qualifications(domain.description, translate(case.description.text, FILE)))
    for state, action in product(known.states, known.own):
        conditions = [one.body for one in found if one.action == action]
        agree(
            f"whether {action} is impossible in {sorted(state)}",
            definition=not known.after(state, frozenset([action])),
            derived=known.forbidden(state, frozenset([action]))
            or any(known.satisfies(state, body) for body in conditions),
        )


def _number(world: World, state: State) -> int:
    return sum(1 << n for n, fluent in enumerate(world.fluents) if fluent in state)


def _sets(world: World, states: Iterable[int]) -> set[State]:
    return {frozenset(world.true_atoms(state)) for state in states}


def _parsed(texts: Iterable[str]) -> frozenset[Literal]:
    return frozenset(map(Literal.parse, texts))


def _compounds(case: Case) -> Iterator[frozenset[str]]:
    """Nothing, each action alone, and some at once."""
    every = (*case.definition.own, *case.definition.others)
    yield frozenset()
    yield from (frozenset([action]) for action in every)
    for _ in range(_COMPOUNDS):
        yield frozenset(case.random.sample(every, min(case.random.randint(2, 3), len(every))))


def check_plans(case: Case) -> None:
    """The first shortest plan, by both planners, and the first conformant one, against a search."""
    reference = ReferencePlanner(case.knowledge)
    for state in case.some_states(_PLANS):
        goal = random_goal(case.description, case.random)
        what = f"plan from {sorted(state)} to {goal}"
        found = case.definition.plan(state, goal)
        agree(what, definition=found, incremental=case.domain.plan(sorted(state), goal))
        conformant = case.domain.plan(sorted(state), goal, _LONGEST_CONFORMANT, "conformant")
        expected = case.definition.conformant_plan(state, goal, _LONGEST_CONFORMANT)
        agree(f"conformant {what}", definition=expected, incremental=conformant)
        if found != () and len(found or ()) <= _LONGEST_REFERENCE:
            limit = len(found) if found else _LONGEST_REFERENCE // 2
            plan = reference.shortest(_parsed(state), tuple(map(Literal.parse, goal)), limit)
            agree(what, definition=found, reference=plan)
