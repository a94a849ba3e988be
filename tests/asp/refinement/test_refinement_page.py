"""docs/refinement.md shows statements that are right, and what laws really become."""

import re
from functools import partial
from pathlib import Path

import pytest

from asp.language import Problems, signature_of
from asp.refinement import Transition, load_refinement, parse_fine, relevant, zoom
from tests.literals import parsed

PAGE = (Path(__file__).parents[3] / "docs" / "refinement.md").read_text(encoding="utf-8")
OFFICE = partial(load_refinement, "office.fine")


def test_the_text_shown_follows_the_grammar() -> None:
    (text,) = re.findall(r"^```\n(refines .*?)^```", PAGE, re.MULTILINE | re.DOTALL)
    sections = re.findall(r"^(\w+)$", text, re.MULTILINE)
    assert len(parse_fine(text).statements) == 16
    told = re.findall(r"^\| `(\w+)` \| `", PAGE, re.MULTILINE)
    assert set(sections) == {*told, "laws"} - {"refines"}


ROWS = PAGE.partition("| coarse law |")[2].partition("\n\n")[0]


@pytest.mark.parametrize("law", re.findall(r"`((?:impossible )?\w+\([^`]*)`", ROWS))
def test_a_law_shown_is_one_of_the_office(law: str) -> None:
    coarse = re.sub(r" +", " ", OFFICE().coarse.text)
    assert any(f" {law}." in text for text in (OFFICE().weak.text, coarse))


def test_the_bridge_axiom_shown_is_one_of_the_office() -> None:
    (bridge,) = re.findall(r"`(loc\(X1, X2\) if [^`]*)`", PAGE)
    assert f"  {bridge}." in OFFICE().weak.text


@pytest.mark.parametrize(
    "declared", re.findall(r"^\| `((?:test|can|obs|pos)\w*\([^`]*)`", PAGE, re.M)
)
def test_what_is_declared_for_observation_is(declared: str) -> None:
    assert re.search(rf"^  \w+ {re.escape(declared)}\.$", OFFICE().strong.text, re.MULTILINE)


def test_what_the_example_says_of_the_zoomed_description() -> None:
    before = frozenset(parsed({"loc(rob1,kitchen)", "loc(book1,office2)", "loc(book2,office1)"}))
    after = before ^ {"loc(rob1,kitchen)", "loc(rob1,office2)"}
    move = Transition(before, "move(rob1,office2)", after)
    zoomed = zoom(
        OFFICE().strong, OFFICE(), relevant(OFFICE(), move, parsed(["loc(book1,library)"]))
    )
    constants = signature_of(zoomed, Problems("zoomed")).constants
    assert not {"office1", "book2", "office1_1", "book2_cover"} & constants
    assert {"library_4", "office2_1", "book1_cover", "rob1"} <= constants
