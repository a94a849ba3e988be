"""Planners that a user would take instead of ours, each on the operators of a domain.

Each is a function from an encoding, the true fluents of a state and a goal to the length of a
shortest plan (None: no plan); `outsiders()` has those that this machine has.
"""

from collections.abc import Callable, Sequence
from importlib import import_module
from importlib.util import find_spec
from typing import Any

import clingo
from clingo import ast

from asp.language import Fluent, Literal
from asp.reasoning.planning import Encoding
from benchmarks.search import Search

Planner = Callable[[Encoding, Sequence[Fluent], Sequence[Literal]], int | None]

FAST_DOWNWARD = "unified-planning, Fast Downward"
TELINGO = "telingo"
BREADTH_FIRST = "breadth-first search"

_NEEDS = {
    FAST_DOWNWARD: ("unified_planning", "up_fast_downward"),
    TELINGO: ("telingo",),
    BREADTH_FIRST: (),
}

_TEMPORAL = """
#program initial.
holds(V,X) :- initially(V,X).
#program dynamic.
1 { occurs(O) : _operator(O) } 1.
:- occurs(O), _before(O,V,X), not 'holds(V,X).
changed(V) :- occurs(O), _after(O,V,X).
holds(V,X) :- occurs(O), _after(O,V,X).
holds(V,X) :- 'holds(V,X), not changed(V).
#program final.
:- _wanted(V,X), not holds(V,X).
:- _unwanted(V,X), holds(V,X).
"""


def outsiders() -> dict[str, Planner | None]:
    """Every planner by name; None where its packages are missing."""
    planners = {FAST_DOWNWARD: fast_downward, TELINGO: telingo, BREADTH_FIRST: breadth_first}
    return {
        name: planner if all(map(_is_installed, _NEEDS[name])) else None
        for name, planner in planners.items()
    }


def breadth_first(
    encoding: Encoding, true: Sequence[Fluent], goal: Sequence[Literal]
) -> int | None:
    """Search in this process."""
    return Search(encoding).shortest(true, goal)


def fast_downward(
    encoding: Encoding, true: Sequence[Fluent], goal: Sequence[Literal]
) -> int | None:
    """unified-planning with Fast Downward in its optimal configuration."""
    up = import_module("unified_planning.shortcuts")

    up.get_environment().credits_stream = None
    problem = _problem(up, encoding, true, goal)
    with up.OneshotPlanner(name="fast-downward-opt") as planner:
        plan = planner.solve(problem).plan
    return None if plan is None else len(plan.actions)


def _problem(up: Any, encoding: Encoding, true: Sequence[Fluent], goal: Sequence[Literal]) -> Any:
    """One predicate, `is(variable,value)`: where each value has one of its own, the translator
    takes a hundred times as long to find out which exclude each other."""
    problem = up.Problem("domain")
    variable_type, value_type = up.UserType("variable"), up.UserType("value")
    predicate = up.Fluent("is", up.BoolType(), of=variable_type, to=value_type)
    problem.add_fluent(predicate, default_initial_value=False)
    names = [up.Object(f"v{n}", variable_type) for n in range(len(encoding.domains))]
    values = [up.Object(f"x{n}", value_type) for n in range(max(map(len, encoding.domains)))]
    problem.add_objects([*names, *values])

    def fact(variable: int, value: int) -> Any:
        return predicate(names[variable], values[value])

    for entry in enumerate(_state(encoding, true)):
        problem.set_initial_value(fact(*entry), True)
    for number, operator in enumerate(encoding.operators):
        action = up.InstantaneousAction(f"o{number}")
        before = dict(operator.before)
        for entry in operator.before:
            action.add_precondition(fact(*entry))
        for variable, value in operator.after:
            for other in range(len(encoding.domains[variable])):
                if other == value or before.get(variable, other) == other:
                    action.add_effect(fact(variable, other), other == value)
        problem.add_action(action)
    for literal in goal:
        variable, value, truth = encoding.assignment(literal)
        problem.add_goal(fact(variable, value) if truth else up.Not(fact(variable, value)))
    return problem


def telingo(encoding: Encoding, true: Sequence[Fluent], goal: Sequence[Literal]) -> int | None:
    """telingo in this process, its default configuration."""
    theirs = import_module("telingo")
    lengths: list[int] = []
    control = clingo.Control(["--warn=none"])
    with ast.ProgramBuilder(control) as builder:
        program = "\n".join([_TEMPORAL, "#program initial.", *_facts(encoding, true, goal)])
        signatures, parts = theirs.transformers.transform([program], builder.add)
    theirs.imain(control, signatures, parts, lambda _model, length: lengths.append(length))
    return lengths[0] if lengths else None


def _facts(encoding: Encoding, true: Sequence[Fluent], goal: Sequence[Literal]) -> list[str]:
    """The problem as ASP facts, variables and values by number."""
    lines = [f"initially({v},{x})." for v, x in enumerate(_state(encoding, true))]
    for number, operator in enumerate(encoding.operators):
        lines.append(f"operator({number}).")
        lines += (f"before({number},{v},{x})." for v, x in operator.before)
        lines += (f"after({number},{v},{x})." for v, x in operator.after)
    for literal in goal:
        variable, value, truth = encoding.assignment(literal)
        lines.append(f"{'wanted' if truth else 'unwanted'}({variable},{value}).")
    return lines


def _state(encoding: Encoding, true: Sequence[Fluent]) -> tuple[int, ...]:
    state = encoding.values(true)
    assert state is not None, "problems start in a state"
    return state


def _is_installed(package: str) -> bool:
    return find_spec(package) is not None
