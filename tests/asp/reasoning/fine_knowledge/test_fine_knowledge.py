"""What is known at the fine resolution: by the theory, and by the quick way, which are equal."""

from collections.abc import Sequence
from functools import cache, partial
from itertools import product
from pathlib import Path

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from asp.domains import LevelSize, level_text
from asp.language import Literal
from asp.reasoning.fine_knowledge import IncrementalFineKnowledge, Known, ReferenceFineKnowledge
from asp.reasoning.fine_knowledge.reference import Inferred
from asp.refinement import load, load_refinement
from tests.asp.refinement.levels import of_size
from tests.asp.refinement.locked import locked_texts
from tests.literals import parsed

TABLETOP = str(Path(__file__).parents[2] / "refinement" / "tabletop.fine")
SMALL = partial(of_size, LevelSize(2, 1, 2, ((2, 2),)), "small")
THEORY = cache(lambda: ReferenceFineKnowledge(SMALL()))
QUICK = cache(lambda: IncrementalFineKnowledge(SMALL()))
CELLS = [f"room{room}_{cell}" for room in (1, 2) for cell in (1, 2)]
PARTS = [f"object{thing}_{part}" for thing in (1, 2) for part in (1, 2)]
LOCATIONS = parsed([f"fine_loc({part},{cell})" for part, cell in product(PARTS, CELLS)])
OWN = parsed([f"fine_loc(rob1,{cell})" for cell in CELLS])
HELD = parsed([f"fine_in_hand(rob1,{part})" for part in PARTS])
FINE = [*LOCATIONS, *OWN, *HELD]
ABOUT = frozenset({"rob1", "object1", "object2", "room1", "room2"})

LITERALS = st.sampled_from([*FINE, *OWN, *HELD, *(fluent.complement for fluent in FINE)])
HISTORIES = st.lists(st.lists(LITERALS, min_size=1, max_size=2), max_size=5)


def infer(*seen: Sequence[Literal], known: Known | None = None) -> Inferred:
    return THEORY().infer(known or Known(), seen, ABOUT)


@given(HISTORIES)
@settings(max_examples=150)
def test_the_quick_way_says_what_the_theory_says(history: list[list[Literal]]) -> None:
    known = Known()
    for seen in history:
        after = QUICK().following(known, seen)
        if after is None:  # a contradiction, which the theory has to resolve
            return
        inferred = THEORY().infer(known, [seen], ABOUT)
        assert after == inferred.known
        unknown = {f for f in FINE if f not in after.true and not QUICK().is_false(after, f)}
        assert unknown == inferred.possible
        assert QUICK().coarse(after, SMALL().description.fluents) == inferred.coarse
        known = after


@given(HISTORIES)
@settings(max_examples=60)
def test_step_by_step_or_all_at_once(history: list[list[Literal]]) -> None:
    known: Known | None = Known()
    for seen in history:
        known = None if known is None else QUICK().following(known, seen)
    if known is not None:
        assert THEORY().infer(Known(), history, ABOUT).known == known


@pytest.mark.parametrize("name", ["level.fine", "office.fine", TABLETOP])
def test_all_laws_of_levels_office_and_tabletop_are_simple(name: str) -> None:
    assert IncrementalFineKnowledge(load_refinement(name)).is_simple


def test_laws_about_what_is_false_are_not_simple() -> None:
    coarse, fine = level_text(2, 1, 2, ((1, 1),))
    coarse += "\nfluents\n  inertial free(robot).\nlaws\n  free(R) if -in_hand(R, object1).\n"
    assert not IncrementalFineKnowledge(load(coarse, "c.al", fine, "c.fine")).is_simple


def test_one_component_makes_it_true() -> None:
    coarse = infer(parsed(["fine_loc(object1_1,room1_2)"])).coarse
    assert {"loc(object1,room1)", "-loc(object1,room2)"} <= coarse
    assert not {"loc(object2,room1)", "-loc(object2,room1)"} & coarse


def test_a_room_is_searched_when_every_cell_is() -> None:
    first = parsed(["-fine_loc(object1_1,room1_1)"])
    second = parsed(["-fine_loc(object1_2,room1_2)"])
    assert "-loc(object1,room1)" not in infer(first).coarse
    inferred = infer(first, second)
    assert "-loc(object1,room1)" in inferred.coarse
    assert {f for f in inferred.possible if "object1" in f and "room" in f} == {
        f"fine_loc({part},{cell})"
        for part, cell in product(("object1_1", "object1_2"), ("room2_1", "room2_2"))
    }


def test_what_is_held_moves_along_and_stays_where_it_is_put_down() -> None:
    grasped = parsed(["fine_loc(rob1,room1_1)", "fine_in_hand(rob1,object1_2)"])
    moved = infer(grasped, parsed(["fine_loc(rob1,room1_2)"]))
    assert "fine_loc(object1_1,room1_2)" in moved.known.true
    left = infer(
        parsed(["-fine_in_hand(rob1,object1_2)"]),
        parsed(["fine_loc(rob1,room2_1)"]),
        known=moved.known,
    )
    assert "fine_loc(object1_1,room1_2)" in left.known.true
    assert "loc(object1,room1)" in left.coarse


def test_of_a_wrong_commitment_nothing_is_left() -> None:
    mistaken = infer(
        parsed(["-fine_loc(object1_1,room2_1)"]), parsed(["fine_loc(object1_1,room1_1)"])
    )
    found_out = infer(parsed(["-fine_loc(object1_1,room1_1)"]), known=mistaken.known)
    assert found_out.known == Known(
        frozenset(),
        frozenset(parsed(["fine_loc(object1_1,room2_1)", "fine_loc(object1_1,room1_1)"])),
    )
    assert "fine_loc(object1_2,room1_2)" in found_out.possible


def test_of_what_contradicts_by_way_of_laws_the_least_is_forgotten() -> None:
    grasped = infer(parsed(["fine_loc(rob1,room1_1)", "fine_in_hand(rob1,object1_1)"])).known
    seen = parsed(["fine_loc(object1_1,room2_2)"])
    assert QUICK().following(grasped, seen) is None
    after = infer(seen, known=grasped).known
    assert "fine_loc(object1_1,room2_2)" in after.true
    assert len(after.true & grasped.true) == 1


def test_where_laws_are_not_simple_and_where_there_is_a_choice_the_theory_is_asked() -> None:
    grasped = infer(parsed(["fine_loc(rob1,room1_1)", "fine_in_hand(rob1,object1_1)"])).known
    seen = parsed(["fine_loc(object1_1,room2_2)"])
    assert QUICK().after(grasped, seen) == THEORY().after(grasped, seen)


def test_one_moment_cannot_contradict_itself() -> None:
    with pytest.raises(ValueError, match="contradict"):
        infer(parsed(["fine_loc(object1_1,room1_1)", "fine_loc(object1_2,room1_2)"]))


def test_unmagnified_fluents_do_not_stand_in_the_way() -> None:
    refinement = load(*locked_texts())
    known = ReferenceFineKnowledge(refinement).infer(
        Known(), [parsed(["fine_loc(cover,k1)"])], ["kitchen", "library"]
    )
    assert {"loc(book1,kitchen)", "-loc(book1,library)"} <= known.coarse
    assert (
        IncrementalFineKnowledge(refinement).following(Known(), parsed(["fine_loc(cover,k1)"]))
        == known.known
    )
