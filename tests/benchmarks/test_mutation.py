"""Theories without one of their statements: what is left out, and which tests miss it."""

from itertools import chain
from pathlib import Path

import pytest
from clingo.ast import AST, ASTType, parse_string

from asp.solving import theory
from benchmarks import mutation, statements
from benchmarks.exercised import EXERCISED
from benchmarks.mutants import ROOT, check_killers
from benchmarks.sheets import DisagreementError
from benchmarks.statements import theories, without

TEXT = """\
% What follows.
a :- b,
    c.
% Bounds.
% redundant: whatever holds is
% at most 3.
:- 3 < #count { X : d(X) }.
:- d(1).

#show a/0.
"""


def _parsed(text: str) -> list[str]:
    nodes: list[AST] = []
    parse_string(text, nodes.append)
    kept = {ASTType.Rule, ASTType.Minimize, ASTType.Heuristic, ASTType.External}
    return [str(node) for node in nodes if node.ast_type in kept]


@pytest.mark.parametrize("name", theories())
def test_leaving_out_each_statement_of_a_theory_leaves_the_others(name: str) -> None:
    found = list(statements.statements(name))
    of_each = [_parsed(statement.text) for statement in found]
    assert [*chain(*of_each)] == _parsed(theory(name))
    for number, statement in enumerate(found):
        rest = without(name, statement.line)
        assert _parsed(rest) == [*chain(*of_each[:number], *of_each[number + 1 :])]
        assert rest.count("\n") == theory(name).count("\n")


def test_a_statement_that_only_saves_time_says_why(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(statements, "theory", lambda _: TEXT)
    told = [(found.line, found.text, found.redundant) for found in statements.statements("own")]
    assert told == [
        (2, "a :- b, c.", ""),
        (7, ":- 3 < #count { X : d(X) }.", "whatever holds is at most 3."),
        (8, ":- d(1).", ""),
    ]


@pytest.mark.parametrize("line", [1, 3, 9, 10, 11])
def test_where_no_statement_begins_none_is_left_out(
    line: int, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(statements, "theory", lambda _: TEXT)
    with pytest.raises(ValueError, match=rf"no rule begins in line {line} of own\.lp"):
        without("own", line)


def test_every_statement_is_left_out_by_itself_or_in_its_axiom() -> None:
    by_itself = {statement.key for statement in mutation.unlabelled()}
    stated = [statement for name in theories() for statement in statements.statements(name)]
    in_axioms = [statement for statement in stated if statement.key not in by_itself]
    of_axioms = [number for number, rule in mutation.all_mutants() if rule is not None]
    with_one_rule = {number for number, _ in mutation.all_mutants()} - set(of_axioms)
    assert len(in_axioms) == len(of_axioms) + len(with_one_rule)
    assert {statement.theory for statement in in_axioms} <= {
        *("history", "intentions", "diagnosis", "planning", "defaults", "fine_planning")
    }


def test_every_theory_has_tests() -> None:
    assert sorted(EXERCISED) == theories()
    paths = {test.split("::")[0] for tests in EXERCISED.values() for test in tests}
    assert [path for path in paths if not (ROOT / path).is_file()] == []


def test_a_test_that_fails_anyway_misses_nothing(tmp_path: Path) -> None:
    path = tmp_path / "test_own.py"
    path.write_text("def test_well(): pass\n\ndef test_never(): assert False\n", encoding="utf-8")
    check_killers(["", f"{path}::test_well"])
    with pytest.raises(DisagreementError, match=r"test_own\.py::test_never fails with nothing"):
        check_killers([f"{path}::test_never"])
