"""What the statements of AL_d say: sorts, variables, laws, statics, and the other sections."""

from itertools import product

import pytest

from asp import Description, load_description, parse_description
from asp.language import Causal, Constraint, Default, Draw, Executability, Sees, Shows, Trigger

# A harbour: ships of two kinds, berths in a row, cranes that serve some of them.
SIGNATURE = """\
sorts
  ferry = {anna, berta}.
  tug   = {carl}.
  ship  = tug + ferry.
  berth = {1..3}.
  place = berth + {sea}.
statics
  beside(berth, berth).
  crane(berth).
fluents
  inertial at(ship, place).
  inertial loaded(ship).
  inertial storm.
  defined  busy(berth).
actions
  agent     sail(ship, place).
  agent     load(ship).
  exogenous blow_up.
"""


def harbour(text: str) -> Description:
    return parse_description(SIGNATURE + text, "harbour.al")


class TestSorts:
    def test_members_stand_in_the_order_of_declaration_through_unions(self) -> None:
        assert harbour("").sorts == {
            "ferry": ("anna", "berta"),
            "tug": ("carl",),
            "ship": ("carl", "anna", "berta"),
            "berth": ("1", "2", "3"),
            "place": ("1", "2", "3", "sea"),
        }

    def test_a_member_of_several_parts_is_one_member(self) -> None:
        sorts = harbour("sorts\n  all = ferry + {zoe} + ship.").sorts
        assert sorts["all"] == ("anna", "berta", "zoe", "carl")

    def test_a_number_is_written_in_one_way(self) -> None:
        assert harbour("sorts\n  year = {007..009}.\n  age = {07}.").sorts["year"] == (
            "7",
            "8",
            "9",
        )

    def test_symbols_are_instantiated_in_the_order_of_declaration(self) -> None:
        assert harbour("").agent_actions == (
            *("sail(carl,1)", "sail(carl,2)", "sail(carl,3)", "sail(carl,sea)"),
            *("sail(anna,1)", "sail(anna,2)", "sail(anna,3)", "sail(anna,sea)"),
            *("sail(berta,1)", "sail(berta,2)", "sail(berta,3)", "sail(berta,sea)"),
            *("load(carl)", "load(anna)", "load(berta)"),
        )
        assert harbour("").inertial[-4:] == (
            *("loaded(carl)", "loaded(anna)", "loaded(berta)"),
            "storm",
        )
        assert harbour("").defined == ("busy(1)", "busy(2)", "busy(3)")
        assert harbour("").exogenous_actions == ("blow_up",)


class TestVariables:
    def test_a_variable_ranges_over_what_its_places_have_in_common(self) -> None:
        laws = harbour("laws\n  busy(B) if at(anna, B).").constraints
        assert laws == tuple(Constraint(f"busy({b})", (f"at(anna,{b})",)) for b in (1, 2, 3))

    def test_a_sort_in_a_body_narrows_a_variable(self) -> None:
        laws = harbour("laws\n  blow_up causes -loaded(S) if ferry(S).").causal
        assert laws == (
            Causal("blow_up", "-loaded(anna)", ()),
            Causal("blow_up", "-loaded(berta)", ()),
        )

    def test_a_law_without_a_body_stands_for_all_of_its_instances(self) -> None:
        laws = harbour("laws\n  sail(S, P) causes at(S, P).").causal
        ships, places = ("carl", "anna", "berta"), ("1", "2", "3", "sea")
        assert laws == tuple(
            Causal(f"sail({s},{p})", f"at({s},{p})", ()) for s, p in product(ships, places)
        )

    def test_unequal_leaves_out_the_instances_that_are_equal(self) -> None:
        laws = harbour("laws\n  -at(anna, P) if at(anna, Q), P != Q.").constraints
        places = ("1", "2", "3", "sea")
        assert set(laws) == {
            Constraint(f"-at(anna,{p})", (f"at(anna,{q})",))
            for p, q in product(places, places)
            if p != q
        }

    def test_equal_keeps_them_alone_also_with_a_constant(self) -> None:
        same = "laws\n  impossible load(S), load(T) if S = T, S = anna, loaded(T)."
        assert harbour(same).executability == (
            Executability(("load(anna)", "load(anna)"), ("loaded(anna)",)),
        )


class TestStatics:
    FACTS = "facts\n  beside(1, 2).\n  beside(2, 3).\n  crane(2).\n"

    def test_statics_are_closed_under_their_laws_and_false_beyond(self) -> None:
        laws = "laws\n  beside(X, Y) if beside(Y, X).\n"
        assert harbour(self.FACTS + laws).statics == {
            *("beside(1,2)", "beside(2,1)", "beside(2,3)", "beside(3,2)", "crane(2)")
        }

    def test_what_follows_from_what_follows_is_derived_too(self) -> None:
        laws = "laws\n  beside(X, Z) if beside(X, Y), beside(Y, Z).\n"
        assert "beside(1,3)" in harbour(self.FACTS + laws).statics

    def test_statics_are_evaluated_away(self) -> None:
        law = "laws\n  impossible load(S) if at(S, B), -crane(B).\n"
        assert harbour(self.FACTS + law).executability == tuple(
            Executability((f"load({s})",), (f"at({s},{b})",))
            for s, b in product(("carl", "anna", "berta"), (1, 3))
        )

    def test_a_negated_static_is_false_also_where_a_law_derives_it_later(self) -> None:
        # crane(3) follows from crane(2) in the second round only.
        laws = "statics\n  bare(berth).\nlaws\n  bare(B) if -crane(B).\n"
        laws += "  crane(B) if crane(A), beside(A, B).\n"
        assert harbour(self.FACTS + laws).statics == {
            *("beside(1,2)", "beside(2,3)", "crane(2)", "crane(3)", "bare(1)")
        }

    def test_a_fact_with_a_variable_is_a_fact_for_each_member(self) -> None:
        assert harbour("facts\n  crane(B).").statics == {"crane(1)", "crane(2)", "crane(3)"}


class TestForm:
    def test_negation_stands_in_heads_and_bodies(self) -> None:
        (law,) = harbour("laws\n  - storm if -loaded(carl), - at(carl, sea).").constraints
        assert law == Constraint("-storm", ("-loaded(carl)", "-at(carl,sea)"))

    def test_comments_stand_anywhere_and_say_nothing(self) -> None:
        plain = harbour("laws\n  storm if loaded(carl), loaded(anna).")
        text = "laws % sorts\n  storm % one\n  if loaded(carl),%two.\n % -storm.\n loaded(anna).%"
        assert harbour(text).constraints == plain.constraints

    def test_sections_may_repeat_and_stand_in_any_order_behind_the_sorts(self) -> None:
        parts = ["laws\n  storm if loaded(carl).", "facts\n  crane(1).", "laws\n  -storm if dry.\n"]
        description = harbour("fluents\n  inertial dry.\n" + "\n".join(parts))
        assert [law.head for law in description.constraints] == ["storm", "-storm"]
        assert description.statics == {"crane(1)"}
        assert description.inertial[-1] == "dry"

    def test_a_section_word_may_be_a_name_where_it_does_not_stand_alone(self) -> None:
        text = "fluents\n  inertial facts.\nlaws\n  facts if storm.\n"
        assert harbour(text).constraints == (Constraint("facts", ("storm",)),)

    def test_statements_may_stand_on_one_line_or_on_several(self) -> None:
        text = "laws\n  storm if loaded(carl). loaded(anna)\n    if\n  storm\n.\r\n"
        assert [law.head for law in harbour(text).constraints] == ["storm", "loaded(anna)"]

    @pytest.mark.parametrize("text", ["", "% nothing\n", "sorts\nlaws\n"])
    def test_a_domain_may_be_empty(self, text: str) -> None:
        assert parse_description(text, "empty.al").fluents == ()


class TestOtherSections:
    def test_sees_says_in_which_states_a_robot_sees_a_fluent(self) -> None:
        text = "sees\n  S sees loaded(T) if at(S, P), at(T, P), tug(S), ferry(T), P != sea.\n"
        text += "  anna sees storm."
        seen = harbour(text).sees
        assert len(seen) == 1 * 2 * 3 + 1
        assert seen[0] == Sees("carl", "loaded(anna)", ("at(carl,1)", "at(anna,1)"))
        assert seen[-1] == Sees("anna", "storm", ())
        assert harbour(text).robots == ("carl", "anna")

    def test_shows_says_what_an_outcome_lets_see(self) -> None:
        text = "shows\n  sail(S, P) shows storm if at(S, sea), tug(S), berth(P)."
        assert harbour(text).shows == tuple(
            Shows(f"sail(carl,{p})", "storm", ("at(carl,sea)",)) for p in (1, 2, 3)
        )

    def test_costs_are_units_of_each_action_and_0_where_nothing_is_said(self) -> None:
        costs = harbour("costs\n  load(S) costs 5.\n  sail(carl, P) costs 12.").costs
        assert costs["load(berta)"] == 5
        assert costs["sail(carl,sea)"] == 12
        assert costs["sail(anna,sea)"] == 0
        assert set(costs) == set(harbour("").agent_actions)

    def test_initially_asks_for_one_of_the_fluents_for_each_other_variable(self) -> None:
        assert harbour("initially\n  at(S, P) for some P.").initially == tuple(
            tuple(f"at({ship},{place})" for place in ("1", "2", "3", "sea"))
            for ship in ("carl", "anna", "berta")
        )

    def test_a_scenario_has_a_trigger_for_each_instance_of_its_statements(self) -> None:
        text = """\
scenarios
  gale: blow_up upon sail(S, sea) drawing S with -loaded(S), tug(S) if -storm probability 0.25.
  gale: blow_up upon any.
  calm: nothing.
  7: blow_up upon load(anna) if storm.
"""
        description = harbour(text)
        assert description.scenarios == ("gale", "calm", "7")
        assert description.triggers == (
            Trigger(
                *("gale", "blow_up", "sail(carl,sea)"),
                (Draw("carl", ("-loaded(carl)",)),),
                ("-storm",),
                0.25,
            ),
            Trigger("gale", "blow_up", None, (), (), 1.0),
            Trigger("7", "blow_up", "load(anna)", (), ("storm",), 1.0),
        )

    def test_a_trigger_has_its_draws_in_their_order_and_the_robots_action_as_a_condition(
        self,
    ) -> None:
        text = """\
scenarios
  mine-field: blow_up upon any drawing P with P = sea then S with tug(S), -load(S), -at(S, P).
"""
        description = harbour(text)
        assert description.scenarios == ("mine-field",)
        assert [trigger.drawings for trigger in description.triggers] == [
            (Draw("sea", ()), Draw("carl", ("-load(carl)", "-at(carl,sea)")))
        ]


class TestOffice:
    """The signature of D 1.1, counted and spelt out by hand."""

    ROOMS = ("kitchen", "library", "office1", "office2")
    BOOKS = ("book1", "book2")

    def test_sorts(self) -> None:
        sorts = {name: set(members) for name, members in load_description("office").sorts.items()}
        assert sorts == {
            "secure_room": {"library"},
            "room": set(self.ROOMS),
            "robot": {"rob1"},
            "book": set(self.BOOKS),
            "object": set(self.BOOKS),
            "thing": {"rob1", *self.BOOKS},
        }

    def test_fluents(self) -> None:
        office = load_description("office")
        things = ("rob1", *self.BOOKS)
        located = {f"loc({t},{r})" for t, r in product(things, self.ROOMS)}
        held = {f"in_hand(rob1,{b})" for b in self.BOOKS}
        assert set(office.inertial) == located | held | {"locked(library)"}
        assert len(office.inertial) == 3 * 4 + 2 + 1
        assert office.defined == ()

    def test_actions(self) -> None:
        office = load_description("office")
        moves = {f"move(rob1,{r})" for r in self.ROOMS}
        handling = {f"{a}(rob1,{b})" for a, b in product(("pickup", "put_down"), self.BOOKS)}
        assert set(office.agent_actions) == moves | handling | {"unlock(rob1,library)"}
        assert len(office.agent_actions) == 9
        moved = {f"exo_move({b},{r})" for b, r in product(self.BOOKS, self.ROOMS)}
        assert set(office.exogenous_actions) == moved | {"exo_lock(library)"}
        assert len(office.exogenous_actions) == 9

    def test_rooms_next_to_each_other(self) -> None:
        pairs = [("office1", "office2"), ("office2", "kitchen"), ("kitchen", "library")]
        both = pairs + [(b, a) for a, b in pairs]
        assert load_description("office").statics == {f"next_to({a},{b})" for a, b in both}

    def test_laws_have_as_many_instances_as_their_variables_allow(self) -> None:
        office = load_description("office")
        # move, pickup, put_down, unlock, exo_lock, exo_move
        assert len(office.causal) == 4 + 2 + 2 + 1 + 1 + 8
        # one place of each thing, what is held goes along, one object in the hand
        assert len(office.constraints) == 3 * 4 * 3 + 4 * 2 + 2
        # move: there, not next to (or the same), out of and into the library; unlock: open, not
        # next to; put_down; pickup: full hand, elsewhere; then the exogenous ones
        robot = 4 + (16 - 6) + 4 + 1 + 1 + 2 + 2 + 4 + 2 * 4 * 3
        exogenous = 8 + 2 + 8 + 8 + 1
        assert len(office.executability) == robot + exogenous

    def test_execution_units(self) -> None:
        costs = load_description("office").costs
        assert {costs[a] for a in costs if a.startswith("move(")} == {15}
        assert {costs[a] for a in costs if not a.startswith("move(")} == {5}


class TestDefaults:
    def test_a_default_has_an_instance_for_each_of_its_variables(self) -> None:
        defaults = harbour("defaults\n  moored: at(F, 1) if ferry(F), -storm.").defaults
        assert defaults == (
            Default("moored(anna)", "at(anna,1)", ("-storm",), ()),
            Default("moored(berta)", "at(berta,1)", ("-storm",), ()),
        )

    def test_a_default_without_variables_has_its_bare_name(self) -> None:
        assert harbour("defaults\n  calm: -storm.").defaults == (Default("calm", "-storm", (), ()),)

    def test_defaults_stand_in_the_order_of_the_source(self) -> None:
        names = [d.name for d in harbour("defaults\n b: storm.\n a: loaded(S).").defaults]
        assert names == ["b", "a(carl)", "a(anna)", "a(berta)"]

    def test_an_exception_on_sorts_and_statics_leaves_instances_out(self) -> None:
        text = "defaults\n  d: loaded(S).\n  exception d if tug(S).\n  exception d if S = anna."
        assert [d.name for d in harbour(text).defaults] == ["d(berta)"]

    def test_an_exception_on_fluents_is_a_condition(self) -> None:
        text = "defaults\n  d: loaded(F) if ferry(F).\n  exception d if at(F, sea).\n"
        text += "  exception d if storm, F != anna."
        (anna, berta) = harbour(text).defaults
        assert anna.exceptions == (("at(anna,sea)",),)
        assert berta.exceptions == (("at(berta,sea)",), ("storm",))

    def test_an_exception_may_stand_before_its_default(self) -> None:
        text = "defaults\n  exception d if ferry(S).\n  d: loaded(S)."
        assert [d.name for d in harbour(text).defaults] == ["d(carl)"]

    def test_an_exception_for_some_other_thing_has_a_variable_of_its_own(self) -> None:
        text = "facts\n  crane(2).\ndefaults\n  d: -storm.\n  exception d if busy(B), crane(B)."
        assert harbour(text).defaults == (Default("d", "-storm", (), (("busy(2)",),)),)
