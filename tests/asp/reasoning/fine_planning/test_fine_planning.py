"""Every rule of the theory of fine planning does something: a case fails without it."""

import pytest

from tests.asp.theories.axioms import lettered
from tests.asp.theories.cases_of_fine_planning import CASES, FineCase


def _name(case: FineCase) -> str:
    return f"({case.paragraph}.{case.rule}) {case.sentence}"


def test_every_rule_has_a_case() -> None:
    stated = {
        (str(number).removeprefix("fine_planning."), rule)
        for number, block in lettered("fine_planning").items()
        for rule in range(1, len(block.rules) + 1)
    }
    assert {(case.paragraph, case.rule) for case in CASES} == stated


@pytest.mark.parametrize("case", CASES, ids=_name)
def test_what_a_rule_says_holds_with_it_and_fails_without_it(case: FineCase) -> None:
    assert case.claim.holds(case.program.solver())
    assert not case.claim.holds(case.program.solver(case.without))
