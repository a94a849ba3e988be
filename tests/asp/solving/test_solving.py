"""Solving within limits: interrupted controls stay usable, cores are smallest, models are all."""

import os
import signal
import subprocess
import sys
import time
from itertools import combinations
from pathlib import Path

import clingo
import pytest
from hypothesis import given
from hypothesis import strategies as st

from asp.solving import (
    LimitError,
    Limits,
    answer_sets,
    core,
    deciding,
    first_model,
    ground,
    is_satisfiable,
    optimal_model,
)

pytestmark = pytest.mark.versions

# Eleven pigeons and ten holes: the solver would need hours to see that it is impossible.
PIGEONS = """
{ crowd }.
1 { at(P,H) : H = 1..11 } 1 :- P = 1..12, crowd.
:- at(P,H), at(Q,H), P < Q.
#show crowd/0.
"""
CROWD = clingo.Function("crowd")


def test_an_interrupted_control_stays_usable() -> None:
    control = ground([PIGEONS], {}, [])
    for _ in range(2):
        with deciding(Limits(0.2)), pytest.raises(LimitError):
            first_model(control, [(CROWD, True)])
        assert first_model(control, [(CROWD, False)]) == ()
        with deciding(Limits(3600.0)):
            assert is_satisfiable(control)


def test_a_limit_that_has_run_out_stops_the_next_call() -> None:
    control = ground(["a."], {}, [])
    with deciding(Limits(0.0)), pytest.raises(LimitError):
        is_satisfiable(control)
    assert is_satisfiable(control)


def test_a_hard_question_is_answered_where_the_first_burst_does_not_suffice() -> None:
    """Eight pigeons and seven holes take more conflicts than a burst has."""
    text = PIGEONS.replace("1..11", "1..7").replace("1..12", "1..8")
    control = ground([text], {}, [])
    assert control.configuration.solve.solve_limit == "2000,umax"  # type: ignore[union-attr]
    assert first_model(control, [(CROWD, True)]) is None
    assert int(control.statistics["solving"]["solvers"]["conflicts"]) > 0
    assert answer_sets(control) == ([()], False)


@pytest.mark.load
@pytest.mark.parametrize("delay", [0.0, 0.001, 0.003, 0.1, 0.5])
def test_an_interrupt_reaches_python_whatever_the_solver_does(delay: float) -> None:
    program = (
        "import clingo\n"
        "from asp.solving import first_model, ground\n"
        f"control = ground([{PIGEONS!r}], {{}}, [])\n"
        "try:\n"
        "    print('ready', flush=True)\n"
        "    first_model(control, [(clingo.Function('crowd'), True)])\n"
        "except KeyboardInterrupt:\n"
        "    print('interrupted', first_model(control, [(clingo.Function('crowd'), False)]))\n"
    )
    process = subprocess.Popen(
        [sys.executable, "-c", program],
        stdout=subprocess.PIPE,
        text=True,
        cwd=Path(__file__).parents[3],
    )
    assert process.stdout is not None
    assert process.stdout.readline() == "ready\n"
    time.sleep(delay)
    os.kill(process.pid, signal.SIGINT)
    try:
        assert process.communicate()[0] == "interrupted ()\n"
    finally:
        process.kill()


CLASHES = st.lists(st.sets(st.integers(0, 5), min_size=1, max_size=4), max_size=4)


@given(clashes=CLASHES)
def test_a_core_is_smallest_and_prefers_what_comes_late(clashes: list[set[int]]) -> None:
    rules = [f":- {', '.join(f's({i})' for i in sorted(clash))}." for clash in clashes]
    control = ground(["{ s(0..5) }.", *rules], {}, [])
    numbers = [clingo.Function("s", [clingo.Number(i)]) for i in range(6)]
    known = [control.symbolic_atoms[number] for number in numbers]
    literals = [atom.literal if atom else 0 for atom in known]
    if 0 in literals:  # something clashes with itself, and the grounder knows
        return

    def clash(chosen: set[int]) -> bool:
        return any(c <= chosen for c in clashes)

    sets = [set(c) for size in range(7) for c in combinations(range(6), size)]
    smallest = [c for c in sets if clash(c) and not any(clash(c - {i}) for i in c)]
    found = core(control, [], literals)
    if not smallest:
        assert found is None
    else:
        assert found is not None
        expected = min(smallest, key=lambda c: [i in c for i in range(6)])
        assert {literals.index(literal) for literal in found} == expected


def test_answer_sets_are_counted_once_each_up_to_a_bound() -> None:
    control = ground(["{ a; b }. { hidden }. #show a/0. #show b/0."], {}, [])
    every, more = answer_sets(control)
    assert ({frozenset(map(str, shown)) for shown in every}, len(every), more) == (
        {frozenset(), frozenset("a"), frozenset("b"), frozenset("ab")},
        4,
        False,
    )
    assert (len(answer_sets(control, most=3)[0]), answer_sets(control, most=3)[1]) == (3, True)
    assert answer_sets(control, most=4)[1] is False
    assert first_model(control) is not None


@given(st.lists(st.tuples(st.integers(0, 3), st.integers(0, 3)), min_size=1, max_size=5))
def test_the_optimum_is_the_least_by_priority_and_then_by_weight(
    costs: list[tuple[int, int]],
) -> None:
    rules = [
        f"#minimize {{ {high}@2 : pick({n}); {low}@1 : pick({n}) }}."
        for n, (high, low) in enumerate(costs)
    ]
    control = ground([f"1 {{ pick(0..{len(costs) - 1}) }} 1.", *rules], {}, ())
    model, proved = optimal_model(control)
    assert model is not None
    assert proved
    assert costs[model[0].arguments[0].number] == min(costs)


def test_a_program_without_answer_sets_has_no_optimum() -> None:
    assert optimal_model(ground(["a. :- a. #minimize { 1 : a }."], {}, ())) == (None, True)


def test_a_search_for_an_optimum_ends_with_the_time() -> None:
    """So many pigeons that the least number without a hole of its own takes long to prove."""
    pigeons = (
        "1 { in(P,H) : H = 1..11 } 1 :- P = 1..14. #minimize { 1,P,Q : in(P,H), in(Q,H), P<Q }."
    )
    control = ground([pigeons], {}, ())
    with deciding(Limits(0.2)), pytest.raises(LimitError):
        optimal_model(control)
    with deciding(Limits(3600.0)):
        assert is_satisfiable(control)
