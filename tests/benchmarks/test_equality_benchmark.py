"""Random descriptions: every way of reasoning is true to the definition, or refuses the text."""

from collections import Counter
from pathlib import Path

import pytest

from benchmarks import equality
from benchmarks.descriptions.case import Case
from benchmarks.descriptions.definition import Definition
from benchmarks.descriptions.transitions import check_diagram
from benchmarks.equality import AGREED, CHECKS, DESCRIPTIONS, LEFT_OUT, REFUSED, main, verdicts
from benchmarks.sheets import DisagreementError

SEEDS = range(100)
OUTCOMES = {AGREED, LEFT_OUT, REFUSED}


@pytest.mark.parametrize("seed", SEEDS)
def test_all_ways_agree_in_a_random_description(seed: int, tmp_path: Path) -> None:
    found = dict(verdicts(seed, tmp_path))
    assert found.keys() == CHECKS.keys()
    assert {check: told for check, told in found.items() if told not in OUTCOMES} == {}


def test_the_descriptions_differ_and_have_every_kind_of_statement(tmp_path: Path) -> None:
    cases = [Case.of(seed, tmp_path) for seed in SEEDS]
    spoken = [case for case in cases if case.is_of_the_language]
    assert len({case.description.text for case in cases}) == len(cases)
    assert 50 <= len(spoken) <= 95
    statements = [s for case in spoken for s in case.description.statements]
    assert {s.kind for s in statements} == {
        *("causes", "law", "impossible", "fact", "some"),
        *("default", "exception", "sees", "shows"),
    }
    kinds = Counter(kind for case in spoken for kind in {s.kind for s in case.description.symbols})
    assert min(kinds[kind] for kind in ("static", "inertial", "defined", "exogenous")) > 10


def test_some_have_several_outcomes_and_some_ask_for_plans(tmp_path: Path) -> None:
    outcomes, lengths = set(), set()
    for case in (Case.of(seed, tmp_path) for seed in SEEDS):
        if case.is_of_the_language:
            known = case.definition
            goals = [(fluent,) for fluent in known.fluents]
            lengths |= {len(known.plan(s, g) or ()) for s in known.initial[:4] for g in goals}
            outcomes |= {
                len(known.after(s, frozenset([a]))) for s in known.states for a in known.own
            }
    assert {0, 1, 2} <= outcomes
    assert {0, 1, 2, 3} <= lengths


def test_what_came_of_each_check_is_counted(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(DESCRIPTIONS, "small", 4)
    monkeypatch.setattr(equality, "CHECKS", {"transitions": check_diagram})
    (sheet,) = main("small")
    (row,) = sheet.rows
    assert sum(int(row[end] or 0) for end in ("agreed", "left_out", "refused")) == 4


def test_what_is_not_true_to_the_definition_is_told(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(DESCRIPTIONS, "small", 4)
    monkeypatch.setattr(equality, "CHECKS", {"transitions": check_diagram})
    monkeypatch.setattr(Definition, "forbidden", lambda *_: False)
    with pytest.raises(DisagreementError, match="transitions of"):
        main("small")
