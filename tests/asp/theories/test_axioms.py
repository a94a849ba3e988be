"""Every axiom of the theory does something: a case that follows from it fails without it."""

import pytest

from tests.asp.reasoning.stories import Case
from tests.asp.theories.axioms import Without, axioms, lettered
from tests.asp.theories.cases_of_activities import CASES as ACTIVITIES
from tests.asp.theories.cases_of_candidates import CASES as CANDIDATES
from tests.asp.theories.cases_of_conditions import CASES as CONDITIONS
from tests.asp.theories.cases_of_defaults import CASES as DEFAULTS
from tests.asp.theories.cases_of_defaults import CONDITIONS as OF_DEFAULTS
from tests.asp.theories.cases_of_history import CASES as HISTORY
from tests.asp.theories.cases_of_intentions import CASES as INTENTIONS

CASES = (*INTENTIONS, *HISTORY, *ACTIVITIES, *CANDIDATES)


def _name(case: Case) -> str:
    rule = "" if case.rule is None else f".{case.rule}"
    if case.condition is not None:
        rule += f" {case.condition}"
    return f"({case.number}{rule}) {case.sentence}"


def test_the_theories_state_the_axioms_1_to_53_once_each() -> None:
    assert sorted(axioms()) == list(range(1, 54))


def test_every_rule_of_every_axiom_has_a_case() -> None:
    stated = {
        (number, rule)
        for number, block in axioms().items()
        for rule in range(1, len(block.rules) + 1)
    }
    assert {(case.number, case.rule or 1) for case in CASES} == stated


def test_every_rule_about_defaults_and_what_is_kept_has_a_case() -> None:
    stated = {
        (number, rule)
        for theory in ("defaults", "diagnosis")
        for number, block in lettered(theory).items()
        for rule in range(1, len(block.rules) + 1)
    }
    assert {(case.number, case.rule or 1) for case in DEFAULTS} == stated


@pytest.mark.parametrize("case", [*CASES, *DEFAULTS], ids=_name)
def test_what_an_axiom_says_holds_with_it_and_fails_without_it(case: Case) -> None:
    assert case.claim.holds(case.program.solver())
    assert not case.claim.holds(case.program.solver(case.without))


@pytest.mark.parametrize("case", [*CONDITIONS, *OF_DEFAULTS], ids=_name)
def test_an_axiom_says_no_more_than_its_condition_allows(case: Case) -> None:
    assert case.claim.holds(case.program.solver())
    assert not case.claim.holds(case.program.solver(case.without))


@pytest.mark.parametrize("number", range(1, 54))
def test_no_other_axiom_says_the_same(number: int) -> None:
    cases = [case for case in CASES if case.number == number]
    without = Without(number)
    assert not all(case.claim.holds(case.program.solver(without)) for case in cases)
