"""docs/action-language.md shows statements that are right, and names that are refused."""

import re
from pathlib import Path

import pytest

from asp import SourceError, load_description, parse_description

PAGE = (Path(__file__).parents[3] / "docs" / "action-language.md").read_text(encoding="utf-8")
OFFICE, _, _ = load_description("office").source.partition("scenarios\n")
CLAUSES = re.findall(
    r"^\| `[^|]*` \| `(\w+: [^`]*)` \|", PAGE.partition("| clause |")[2], re.MULTILINE
)


@pytest.mark.parametrize("statement", CLAUSES)
def test_every_clause_of_a_scenario_has_an_example(statement: str) -> None:
    description = parse_description(f"{OFFICE}scenarios\n  {statement}\n")
    assert description.scenarios == (statement.partition(":")[0],)


def test_all_the_clauses_are_shown() -> None:
    shown = " ".join(CLAUSES)
    assert all(word in shown for word in ("nothing", "upon", "any", "if", "drawing", "with"))
    assert all(word in shown for word in ("then", "probability"))


def test_actions_that_exclude_each_other_are_written_as_shown() -> None:
    (law,) = re.findall(r"`(impossible [^`]*, exo_[^`]*)`", PAGE)
    laws = parse_description(f"{OFFICE}laws\n  {law}\n").executability
    assert any(len(condition.actions) == 2 for condition in laws)


def test_the_names_that_are_said_to_be_refused_are() -> None:
    told = PAGE[PAGE.index("as fluents and actions") : PAGE.index("and some more of each kind")]
    symbols, others = told.split("as sorts and")
    sorts, constants = others.split("as constants")
    assert_refused("fluents\n  inertial {}.", symbols)
    assert_refused("sorts\n  {} = {{ordinary}}.", sorts)
    assert_refused("sorts\n  ordinary = {{{}}}.", constants)


def assert_refused(declaration: str, told: str) -> None:
    parse_description(declaration.format("other"))
    for name in re.findall("`(.*?)`", told):
        with pytest.raises(SourceError, match=f"'{name}'"):
            parse_description(declaration.format(name))
