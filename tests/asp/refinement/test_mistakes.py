"""Mistakes in the text of a refinement are told with their place, and what would be right."""

from pathlib import Path

import pytest

from asp import SourceError
from asp.language import read_domain
from asp.refinement import load, load_refinement, read_refinement

COARSE = read_domain("level")[1]
FINE = read_refinement("level.fine")[1]
ROOMS = ("room1", "room2", "room3")


def mistakes(fine: str, coarse: str = COARSE) -> list[str]:
    """Each mistake as `line:column: message`, or with its file where that is the coarse one."""
    with pytest.raises(SourceError) as error:
        load(coarse, "c.al", fine, "x.fine")
    return [str(mistake).removeprefix("x.fine:") for mistake in error.value.all]


def changed(old: str, new: str, text: str = FINE) -> str:
    assert text.count(old) == 1, old
    return text.replace(old, new)


def place(fragment: str, text: str) -> str:
    """`line:column` of the only occurrence."""
    before, found, _ = text.partition(fragment)
    assert found
    return f"{before.count(chr(10)) + 1}:{len(before) - before.rfind(chr(10))}"


class TestForm:
    @pytest.mark.parametrize(
        ("old", "new", "message"),
        [
            ("into cell.", "cell.", "5:10: unexpected 'cell'; expected 'into'"),
            ("magnify\n", "magnifies\n", "unknown section 'magnifies'; did you mean 'magnify'?"),
            ("tests\n", "test\n", "unknown section 'test'; did you mean 'tests'?"),
            ("R tests fine_in_hand(R, P).", "fine_in_hand(R, P).", "unexpected"),
            ("fine_in_hand(R, P).\n", "fine_in_hand(R, P)\n", "the text ends inside a statement"),
            ("{room1_1, room1_2}", "{}", "unexpected '}'"),
        ],
    )
    def test_what_does_not_follow_the_grammar(self, old: str, new: str, message: str) -> None:
        (found,) = mistakes(changed(old, new))
        assert message in found

    def test_a_section_that_there_is_not(self) -> None:
        (found,) = mistakes("colour\n")
        assert found.startswith("1:1: unexpected 'colour'; expected a section word")


class TestNames:
    @pytest.mark.parametrize(
        ("old", "new", "at", "message"),
        [
            ("room   into", "rom into", "rom into", "unknown sort 'rom'; did you mean 'room'?"),
            (
                "object into part.",
                "object into thing.",
                "object into thing",
                "the name 'thing' is taken; the fine sort is a new one",
            ),
            (
                "object into part.",
                "object into part. thing into bit.",
                "thing into",
                "'object1' is magnified already, as one of 'object'",
            ),
            (
                "object1 = {",
                "objekt1 = {",
                "objekt1",
                "unknown constant 'objekt1'; did you mean 'object1'?",
            ),
            (
                "object1 = {object1_1, object1_2}.",
                "object1 = {object1_1, object1_2}. rob1 = {arm}.",
                "rob1 = ",
                "'rob1' is of no magnified sort, so that it has no components",
            ),
            (
                "{object2_1, object2_2}",
                "{object2_1, object1_2}",
                "object1_2}.\n\nc",
                "'object1_2' is listed twice, first for 'object1'",
            ),
            (
                "{object2_1, object2_2}",
                "{object2_1, room1}",
                "room1}",
                "the name 'room1' is one of the coarse constants",
            ),
            (
                "object1 = {object1_1, object1_2}.",
                "object1 = {object1_1}. object1 = {object1_2}.",
                "object1 = {object1_2}",
                "the components of 'object1' are listed in line 12 already",
            ),
            (
                "next_to. loc. in_hand.",
                "next_too. next_to. loc. in_hand.",
                "next_too.",
                "unknown static, fluent or action 'next_too'; did you mean 'next_to'?",
            ),
            ("exo_move.", "exo_move. loc.", "loc.\n\n%", "'loc' is listed twice"),
            (
                "fine_loc(T, C) if",
                "loc(T, C) if",
                "loc(T, C) if",
                "'loc' is observed by way of its components only; test 'fine_loc'",
            ),
            (
                "R tests fine_in_hand(R, P).",
                "R tests fine_in_hnd(R, P).",
                "fine_in_hnd(",
                "unknown fluent 'fine_in_hnd'; did you mean 'fine_in_hand'?",
            ),
            (
                "fine_next_to(room1_2, room2_1)",
                "fine_next_to(room1_2, room2_9)",
                "room2_9",
                "'room2_9' is not of sort 'cell'; did you mean 'room2_2'?",
            ),
            (
                "if fine_loc(P2, C),",
                "if fine_loc(P2, room3),",
                "room3), comp",
                "'room3' is not of sort 'cell'; did you mean 'room3_2'?",
            ),
        ],
    )
    def test_it_is_told_where_and_what(self, old: str, new: str, at: str, message: str) -> None:
        fine = changed(old, new)
        found = mistakes(fine)
        assert f"{place(at, fine)}: {message}" in found

    def test_one_fluent_tested_by_two_sorts_of_robots(self) -> None:
        fine = FINE + "  O tests fine_in_hand(R, P) if object(O).\n"
        assert mistakes(fine) == [
            f"{place('O tests', fine)}: 'fine_in_hand' is tested by another sort of robot than in "
            "line 32, which is 'robot'"
        ]

    def test_a_magnified_sort_without_components(self) -> None:
        fine = changed("  object1 = {object1_1, object1_2}.\n", "")
        fine = changed("  object2 = {object2_1, object2_2}.\n", "", fine)
        expected = f"{place('object into', fine)}: no constant of sort 'object' has components"
        assert mistakes(fine) == [expected]

    def test_a_counterpart_of_what_is_not_about_anything_magnified(self) -> None:
        coarse = changed("inertial in_hand(", "inertial tired(robot).\n  inertial in_hand(", COARSE)
        fine = changed("exo_move.\n", "exo_move. tired.\n")
        expected = f"{place('tired', fine)}: 'tired' has no argument of a magnified sort"
        assert mistakes(fine, coarse) == [expected]

    @pytest.mark.parametrize("name", ["component", "fine", "coarse"])
    def test_a_coarse_name_that_refined_descriptions_use(self, name: str) -> None:
        coarse = changed(
            "inertial in_hand(", f"inertial {name}(room).\n  inertial in_hand(", COARSE
        )
        (found,) = mistakes(FINE, coarse)
        assert found.endswith(f"the coarse description has a '{name}'; call it otherwise")

    @pytest.mark.parametrize(
        ("old", "new", "at", "message"),
        [
            ("room   into cell", "room   into step", "step", "means something else in programs"),
            (
                "object1_1, object1_2}",
                "object1_1, not}",
                "not}",
                "means something else in programs",
            ),
            ("room   into cell", "room   into fine_loc", "fine_loc", "is used twice"),
            ("room   into cell", "room   into outcome", "outcome", "is used twice"),
        ],
    )
    def test_a_name_that_refined_descriptions_cannot_have(
        self, old: str, new: str, at: str, message: str
    ) -> None:
        fine = changed(old, new)
        before = fine[: fine.index(at)].split("\n")
        (found,) = mistakes(fine)
        assert found.startswith(f"{len(before)}:{len(before[-1]) + 1}: the name '")
        assert message in found

    def test_a_coarse_name_like_that_of_a_counterpart(self) -> None:
        coarse = changed("  thing  = object", "  fine_thing = {it}.\n  thing  = object", COARSE)
        (found,) = mistakes(FINE, coarse)
        assert "the name 'fine_thing' is used twice" in found

    def test_several_mistakes_are_told_at_once_in_order(self) -> None:
        fine = changed("objekt1 = {", "objekt1 = {", FINE.replace("object1 =", "objekt1 ="))
        fine = changed("next_to. loc.", "next_too. loc.", fine)
        lines = [int(found.partition(":")[0]) for found in mistakes(fine)]
        assert len(lines) == 2
        assert lines == sorted(lines)

    def test_a_component_that_is_the_whole_of_another_name_is_its_own(self) -> None:
        """A constant of a magnified sort that is not listed has itself as its component."""
        fine = changed("  object2 = {object2_1, object2_2}.\n", "")
        refinement = load(COARSE, "c.al", fine, "x.fine")
        assert refinement.components["object2"] == ("object2",)
        assert refinement.weak_signature.sorts["part"] == ("object1_1", "object1_2", "object2")


class TestMaps:
    def test_a_cell_that_cannot_be_reached_inside_its_room(self) -> None:
        fine = changed("  fine_next_to(room2_1, room2_2).\n", "")
        assert mistakes(fine) == [
            f"{place('room2_2}', fine)}: 'room2_2' cannot be reached from 'room2_1' inside 'room2'"
        ]

    def test_a_room_without_cells(self) -> None:
        fine = changed("  room3 = {room3_1, room3_2}.\n", "")
        fine = changed("  fine_next_to(room2_2, room3_1).\n", "", fine)
        fine = changed("  fine_next_to(room3_1, room3_2).\n", "", fine)
        assert mistakes(fine) == [
            f"{place('room   into', fine)}: 'room3' has no components, and no fact speaks of it"
        ]

    def test_a_room_that_is_one_cell_needs_no_components(self) -> None:
        fine = changed("  room3 = {room3_1, room3_2}.\n", "")
        fine = changed("fine_next_to(room2_2, room3_1)", "fine_next_to(room2_2, room3)", fine)
        fine = changed("  fine_next_to(room3_1, room3_2).\n", "", fine)
        refinement = load(COARSE, "c.al", fine, "x.fine")
        assert refinement.weak_signature.sorts["cell"][-1] == "room3"

    def test_neighbours_without_a_doorway(self) -> None:
        fine = changed("  fine_next_to(room1_2, room2_1).\n", "")
        assert mistakes(fine) == [
            f"{place('room1 =', fine)}: next_to(room1, room2), but no component of 'room1' is "
            "fine_next_to to one of 'room2'"
        ]

    def test_a_doorway_between_rooms_that_are_not_neighbours(self) -> None:
        door = "fine_next_to(room3_2, room1_1)"
        fine = changed(
            "  fine_next_to(room1_2, room2_1).\n", f"  {door}.\n  fine_next_to(room1_2, room2_1).\n"
        )
        assert mistakes(fine) == [
            f"{place(door, fine)}: {door} leads from 'room3' to 'room1', "
            "but next_to(room3, room1) does not hold"
        ]

    def test_a_cell_that_cannot_be_left_again(self) -> None:
        """Where ways lead one way: a coarse map without the law that turns them round."""
        coarse = changed("  next_to(L1, L2) if next_to(L2, L1).\n", "", COARSE)
        inside = [
            f"{place(f'{r}_2}}', FINE)}: '{r}_1' cannot be reached from '{r}_2' inside '{r}'"
            for r in ROOMS
        ]
        between = [
            f"{place(f'{r} =', FINE)}: 'room1' cannot be reached from '{r}' by next_to"
            for r in ("room2", "room3")
        ]
        assert sorted(mistakes(FINE, coarse)) == sorted(inside + between)

    def test_a_room_that_no_doorway_leads_to(self) -> None:
        coarse = changed("  next_to(room2, room3).\n", "", COARSE)
        fine = changed("  fine_next_to(room2_2, room3_1).\n", "")
        assert mistakes(fine, coarse) == [
            f"{place('room3 =', fine)}: 'room3' cannot be reached from 'room1' by next_to"
        ]

    def test_a_room_with_a_door_that_leads_in_only(self) -> None:
        """All other ways lead both ways."""
        coarse = changed("  next_to(L1, L2) if next_to(L2, L1).\n", "", COARSE)
        coarse = changed(
            "  next_to(room1, room2).\n",
            "  next_to(room1, room2).\n  next_to(room2, room1).\n",
            coarse,
        )
        fine = FINE
        for one, other in (("room1_2", "room2_1"), *((f"{r}_1", f"{r}_2") for r in ROOMS)):
            way = f"  fine_next_to({one}, {other}).\n"
            fine = changed(way, f"{way}  fine_next_to({other}, {one}).\n", fine)
        assert mistakes(fine, coarse) == [
            f"{place('room3 =', fine)}: 'room1' cannot be reached from 'room3' by next_to"
        ]

    def test_two_doorways_between_neighbours_are_fine(self) -> None:
        load(COARSE, "c.al", changed("facts\n", "facts\n  fine_next_to(room1_1, room2_2).\n"), "x")


class TestLaws:
    def test_an_action_that_changes_what_has_a_counterpart_needs_one(self) -> None:
        fine = changed("pickup. put_down.", "put_down.")
        (found,) = mistakes(fine)
        assert found == (
            f"c.al:{place('pickup(R, O)   causes', COARSE)}: 'pickup' changes 'in_hand', which has "
            "a counterpart, so that 'pickup' needs one"
        )

    def test_a_law_that_does_not_say_for_which_component(self) -> None:
        law = "loc(O, room2) if in_hand(R, O), loc(R, room1), loc(R, room2)"
        coarse = changed("laws\n", f"laws\n  {law}.\n", COARSE)
        assert mistakes(FINE, coarse) == [
            f"c.al:{place('loc(O, room2) if', coarse)}: this law does not say for which of the "
            "components it holds"
        ]

    def test_what_would_be_defined_through_its_own_negation(self) -> None:
        law = "fine_loc(P, C) if -fine_loc(P, C), part(P)"
        fine = changed("laws\n", f"laws\n  {law}.\n")
        (found,) = mistakes(fine)
        assert found.startswith("1:1: 'fine_loc(object1_1,room1_1)' is defined through its own")
        assert law in found

    def test_a_negation_without_a_cycle_is_none(self) -> None:
        """By their names alone the laws might be in a cycle; their instances are not."""
        law = "fine_loc(object1_1, room1_1) if -fine_loc(object2_1, room1_2), fine_next_to(C, C)"
        load(COARSE, "c.al", changed("laws\n", f"laws\n  {law}.\n"), "x")


class TestWhatIsLeftUnsaid:
    def test_a_fluent_that_nobody_can_test(self) -> None:
        (found,) = mistakes(changed("  R tests fine_in_hand(R, P).\n", ""))
        assert found.startswith(f"{place('in_hand. move', FINE)}: ")
        assert "'fine_in_hand'" in found

    def test_components_that_could_be_in_different_places(self) -> None:
        law = next(line for line in FINE.splitlines() if "fine_loc(P1, C)" in line)
        (found,) = mistakes(changed(f"{law}\n", ""))
        assert found.startswith(f"{place('object1 = {', FINE)}: ")
        assert "'fine_loc'" in found


class TestFiles:
    def test_a_text_that_does_not_say_what_it_refines(self, tmp_path: Path) -> None:
        file = tmp_path / "x.fine"
        file.write_text("magnify\n", encoding="utf-8")
        with pytest.raises(SourceError, match=r"begin with 'refines NAME.'"):
            load_refinement(str(file))

    def test_a_text_that_refines_what_there_is_not(self, tmp_path: Path) -> None:
        file = tmp_path / "x.fine"
        file.write_text("% a\nrefines ofice.\n", encoding="utf-8")
        with pytest.raises(SourceError, match=r"x.fine:2:1: ofice: no such domain; .*office"):
            load_refinement(str(file))

    def test_it_refines_the_file_beside_it(self, tmp_path: Path) -> None:
        (tmp_path / "mine.al").write_text(COARSE, encoding="utf-8")
        file = tmp_path / "x.fine"
        file.write_text(changed("refines level.", 'refines "mine.al".'), encoding="utf-8")
        assert load_refinement(str(file)).coarse.file == str(tmp_path / "mine.al")

    def test_a_file_that_is_not_there(self, tmp_path: Path) -> None:
        with pytest.raises(FileNotFoundError):
            load_refinement(str(tmp_path / "x.fine"))
