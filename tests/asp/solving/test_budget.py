"""Whatever takes too long ends at a limit, the same way each time, and leaves controls usable."""

import clingo
import pytest

import asp.reasoning.planning.large.outcomes
from asp.reasoning.planning import IncrementalPlanner
from asp.solving import (
    BudgetError,
    LimitError,
    Limits,
    answer_sets,
    deciding,
    first_model,
    ground,
    is_satisfiable,
    optimal_model,
    up_to,
)
from tests.literals import parsed

# The solver would need hours to see that more pigeons than holes are impossible.
PIGEONS = """
{ crowd }.
1 { at(P,H) : H = 1..holes } 1 :- P = 1..pigeons, crowd.
:- at(P,H), at(Q,H), P < Q.
#show crowd/0.
"""
MANY, SOME = {"pigeons": 12, "holes": 11}, {"pigeons": 8, "holes": 7}
CROWD = clingo.Function("crowd")

# More rules than any memory holds.
EXPLODING = "p(1..20000). q(X,Y,Z) :- p(X), p(Y), p(Z)."


def test_a_search_ends_with_the_conflicts_and_the_control_stays_usable() -> None:
    control = ground([PIGEONS], MANY, [])
    for _ in range(2):
        with deciding(Limits(conflicts=5_000)), pytest.raises(BudgetError):
            first_model(control, [(CROWD, True)])
        assert first_model(control, [(CROWD, False)]) == ()


def test_conflicts_are_those_of_the_whole_decision() -> None:
    control = ground([PIGEONS], SOME, [])
    with deciding(Limits(conflicts=1_000_000)) as whole:
        before = whole.conflicts
        assert first_model(control, [(CROWD, True)]) is None
    assert before is not None
    assert whole.conflicts is not None
    spent = before - whole.conflicts
    # Twice as many suffice for one such question, and not for a hard one beside it.
    with deciding(Limits(conflicts=2 * spent)):
        assert first_model(control, [(CROWD, True)]) is None
        with pytest.raises(BudgetError):
            answer_sets(ground([PIGEONS], MANY, []))


def test_what_a_call_takes_hardly_depends_on_earlier_calls() -> None:
    """Were what it learns kept, the second time would take next to nothing."""
    control, spent = ground([PIGEONS], SOME, []), []
    for _ in range(4):
        with deciding(Limits(conflicts=1_000_000)) as budget:
            assert first_model(control, [(CROWD, True)]) is None
            assert budget.conflicts is not None
            spent.append(1_000_000 - budget.conflicts)
        assert first_model(control, [(CROWD, False)]) == ()
    assert min(spent) > 2_000
    assert max(spent) < 2 * min(spent)


def test_a_part_of_the_budget_leaves_the_rest_for_later() -> None:
    control = ground([PIGEONS], SOME, [])
    with deciding(Limits(conflicts=100_000)):
        with up_to(0.01), pytest.raises(BudgetError):
            first_model(control, [(CROWD, True)])
        assert first_model(control, [(CROWD, True)]) is None


def test_answer_sets_that_the_budget_cuts_off_are_not_taken_for_all_of_them() -> None:
    """One answer set is found at once; that there is no other one takes hours."""
    control = ground([PIGEONS], MANY, [])
    with deciding(Limits(conflicts=5_000)), pytest.raises(BudgetError):
        answer_sets(control)
    assert answer_sets(ground([PIGEONS], SOME, [])) == ([()], False)


def test_the_best_answer_set_found_is_given_where_no_better_one_is_ruled_out() -> None:
    pigeons = (
        "1 { in(P,H) : H = 1..11 } 1 :- P = 1..14. #minimize { 1,P,Q : in(P,H), in(Q,H), P<Q }."
    )
    control = ground([pigeons], {}, ())
    with deciding(Limits(conflicts=20_000)):
        model, proved = optimal_model(control)
    assert model is not None
    assert not proved


@pytest.mark.parametrize(
    ("limits", "error"), [(Limits(ground_rules=5_000), BudgetError), (Limits(0.5), LimitError)]
)
def test_grounding_ends_at_a_limit(limits: Limits, error: type[LimitError]) -> None:
    with deciding(limits), pytest.raises(error):
        ground([EXPLODING], {}, ())
    assert is_satisfiable(ground(["a."], {}, ()))


def test_a_program_below_the_limit_is_ground() -> None:
    with deciding(Limits(60.0, ground_rules=200)):
        for _ in range(2):
            assert is_satisfiable(ground(["p(1..100)."], {}, ()))
        with pytest.raises(BudgetError):
            ground(["p(1..300)."], {}, ())


def test_inside_a_decision_the_time_began_with_it() -> None:
    control = ground(["a."], {}, ())
    with deciding() as whole:
        with deciding(Limits(0.0)), pytest.raises(LimitError):
            is_satisfiable(control)
        assert is_satisfiable(control)
    assert whole.late


STACKING = """
sorts
  crate = {c0, c1, c2}.
  place = crate + {floor}.
  crane = {arm}.
fluents
  inertial on(crate, place).
actions
  agent lift(crane, crate, place).
laws
  lift(A, C, P) causes on(C, P).
  -on(C, P) if on(C, Q), P != Q.
  impossible lift(A, C, P) if on(D, C).
  impossible lift(A, C, D) if on(E, D), crate(D).
  impossible lift(A, C, C).
  impossible lift(A, C, P) if on(C, P).
initially
  on(C, P) for some P.
"""


def test_a_description_with_too_many_cases_is_planned_for_without_them(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    start = frozenset(parsed(["on(c0,c1)", "on(c1,c2)", "on(c2,floor)"]))
    goal = parsed(["on(c2,c1)", "on(c1,c0)", "on(c0,floor)"])
    expected = IncrementalPlanner(STACKING, "stacking.al").shortest(start, goal, 9)
    assert expected is not None
    assert len(expected) == 3
    monkeypatch.setattr(asp.reasoning.planning.large.outcomes, "MOST_BRANCHES", 5)
    plans = IncrementalPlanner(STACKING, "stacking.al")
    assert plans.shortest(start, goal, 9) == expected
    assert plans.reachable(start, goal) is None
