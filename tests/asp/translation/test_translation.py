"""The translated program: readable, accepted by clingo, and the transition diagram of D 1.1."""

import re
from itertools import combinations
from pathlib import Path

import clingo
import pytest

from asp import SourceError, load_description, parse_description
from asp.language import read_domain
from asp.translation import translate
from testbed.world import world_of
from tests.asp.reasoning.diagrams import after, states, warnings_of
from tests.asp.reasoning.stories import CART
from tests.asp.theories.axioms import THEORIES, domain_text, theory_text
from tests.asp.theories.cases_of_candidates import CASES as CANDIDATES
from tests.asp.theories.cases_of_history import CASES as HISTORY

SMALL = """\
% A door with a bell.
sorts
  door = {front, back}.   % two doors
fluents
  inertial open(door).
  inertial bell.
actions
  agent     push(door).
  exogenous ring.
laws
  % What actions do.
  push(D) causes open(D) if -open(D).   % from either side
  ring    causes bell.

  % What always holds,
  % wherever one stands.
  -bell if open(front), open(back).
  -open(X) if open(Y),
    X != Y.
  % What cannot be done.
  impossible push(D)       if open(D).
  impossible push(D), ring if bell.   % not together
"""


def shown(program: str) -> set[str]:
    """The atoms at step 0 that the only answer set of the program shows."""
    control = clingo.Control(["--warn=none", "0", "-c", "n=0"])
    control.add("base", [], program)
    control.ground()
    answers: list[set[str]] = []
    control.solve(on_model=lambda model: answers.append({*map(str, model.symbols(shown=True))}))
    (answer,) = answers
    return answer


def laws_of(program: str) -> list[str]:
    """The lines of the program from the first law's comment to the last law."""
    lines = program.splitlines()
    first = lines.index("% What actions do.")
    last = next(i for i, line in enumerate(lines) if line.endswith("% not together"))
    return [line for line in lines[first : last + 1] if line]


class TestText:
    def test_each_law_is_one_rule_in_the_order_of_the_source_with_its_comments(self) -> None:
        expected = [
            r"% What actions do\.",
            r"holds\(open\(D\),I\+1\) :- occurs\(push\(D\),I\), -holds\(open\(D\),I\), .*\."
            r"  % from either side",
            r"holds\(bell,I\+1\) :- occurs\(ring,I\), .*\.",
            r"% What always holds,",
            r"% wherever one stands\.",
            r"-holds\(bell,I\) :- holds\(open\(front\),I\), holds\(open\(back\),I\), .*\.",
            r"-holds\(open\(X\),I\) :- holds\(open\(Y\),I\), X != Y, .*\.",
            r"% What cannot be done\.",
            r"impossible\(push\(D\),I\) :- holds\(open\(D\),I\), .*\.",
            r":- occurs\(push\(D\),I\), occurs\(ring,I\), holds\(bell,I\), .*\.  % not together",
        ]
        found = laws_of(translate(SMALL))
        assert len(found) == len(expected)
        for line, pattern in zip(found, expected, strict=True):
            assert re.fullmatch(pattern, line)

    def test_every_comment_of_the_office_that_stands_at_a_law_is_there_once(self) -> None:
        _, text = read_domain("office")
        laws = text.partition("\nlaws\n")[2].partition("\nfacts\n")[0]
        comments = re.findall(r"%.*", laws)
        assert len(comments) == 7
        assert [c for c in re.findall(r"%.*", domain_text("office")) if c in comments] == comments

    def test_the_office_has_one_rule_for_each_of_its_laws(self) -> None:
        _, text = read_domain("office")
        laws = re.sub(r"%.*", "", text.partition("\nlaws\n")[2].partition("\nfacts\n")[0])
        stated = laws.count(".")
        assert stated == 6 + 4 + 9 + 5
        program = domain_text("office")
        rules = program.partition("% Causal laws.")[2].partition("next_to(office1,office2).")[0]
        assert (
            sum(line.endswith(".") for line in re.sub(r" *%.*", "", rules).splitlines()) == stated
        )

    @pytest.mark.parametrize("n", [0, 1, 3])
    @pytest.mark.parametrize(
        "text",
        [
            pytest.param(read_domain("office")[1], id="office"),
            pytest.param(Path(CART).read_text(encoding="utf-8"), id="cart"),
            pytest.param(SMALL, id="doors"),
            pytest.param("", id="empty"),
            pytest.param("sorts\n  a = {x}.\nstatics\n  s(a).\nfacts\n  s(x).\n", id="statics"),
            pytest.param("fluents\n  defined d.\n  inertial i.\nlaws\n  d if i.\n", id="fluents"),
            pytest.param("actions\n  exogenous e.\n", id="actions"),
        ],
    )
    def test_clingo_accepts_it_without_a_warning(self, text: str, n: int) -> None:
        assert (
            warnings_of(f"#const n = {n}.\n" + translate(text).replace("#const n = 1.", "")) == []
        )


class TestOffice:
    """Transitions of the published scenarios, and what D 1.1 calls impossible."""

    START = ("loc(rob1,kitchen)", "in_hand(rob1,book1)", "loc(book1,kitchen)", "loc(book2,kitchen)")
    PLAN = (
        ["move(rob1,library)"],
        ["put_down(rob1,book1)"],
        ["move(rob1,kitchen)"],
        ["pickup(rob1,book2)"],
        ["move(rob1,library)"],
        ["put_down(rob1,book2)"],
    )

    def follow(self, *steps: list[str]) -> set[str] | None:
        """The one state that follows, or None if there is none."""
        found = after(domain_text("office"), self.START, *steps)
        assert len(found) <= 1
        return set(*found) if found else None

    def test_scenario_1_ends_with_both_books_in_the_library(self) -> None:
        assert self.follow(*self.PLAN) == {
            *("loc(rob1,library)", "loc(book1,library)", "loc(book2,library)")
        }

    def test_what_is_held_goes_along_and_is_in_one_place(self) -> None:
        assert self.follow(*self.PLAN[:1]) == {
            *("loc(rob1,library)", "loc(book1,library)", "loc(book2,kitchen)"),
            "in_hand(rob1,book1)",
        }

    def test_scenario_2_someone_brings_book2_while_book1_is_put_down(self) -> None:
        steps = [self.PLAN[0], [*self.PLAN[1], "exo_move(book2,library)"]]
        assert self.follow(*steps) == {
            *("loc(rob1,library)", "loc(book1,library)", "loc(book2,library)")
        }

    def test_scenario_5_someone_takes_book1_away_at_the_end(self) -> None:
        steps = [*self.PLAN[:5], [*self.PLAN[5], "exo_move(book1,kitchen)"]]
        assert self.follow(*steps) == {
            *("loc(rob1,library)", "loc(book1,kitchen)", "loc(book2,library)")
        }

    def test_scenario_6_a_locked_library_is_unlocked_from_the_kitchen(self) -> None:
        assert self.follow(["exo_lock(library)"], ["move(rob1,library)"]) is None
        steps = (["exo_lock(library)"], ["unlock(rob1,library)"], ["move(rob1,library)"])
        assert self.follow(*steps) == self.follow(*self.PLAN[:1])

    @pytest.mark.parametrize(
        ("before", "actions"),
        [
            ([], ["move(rob1,kitchen)"]),
            ([], ["move(rob1,office1)"]),
            ([], ["unlock(rob1,library)"]),
            ([], ["put_down(rob1,book2)"]),
            ([], ["pickup(rob1,book2)"]),
            ([], ["exo_move(book2,kitchen)"]),
            ([], ["exo_move(book1,office1)"]),
            ([["exo_lock(library)"]], ["exo_lock(library)"]),
            ([["exo_lock(library)"]], ["exo_move(book2,library)"]),
            ([["move(rob1,library)"], ["exo_lock(library)"]], ["move(rob1,kitchen)"]),
            ([["move(rob1,office2)"], ["exo_lock(library)"]], ["unlock(rob1,library)"]),
            ([["put_down(rob1,book1)"], ["move(rob1,library)"]], ["pickup(rob1,book2)"]),
            ([["exo_move(book2,library)"], ["exo_lock(library)"]], ["exo_move(book2,office1)"]),
            ([], ["exo_move(book2,office1)", "exo_move(book2,office2)"]),
        ],
    )
    def test_what_is_impossible_has_no_successor(
        self, before: list[list[str]], actions: list[str]
    ) -> None:
        assert self.follow(*before) is not None
        assert self.follow(*before, actions) is None


class TestMeaning:
    def test_a_defined_fluent_is_true_exactly_where_it_is_derived(self) -> None:
        for state in states(domain_text(CART)):
            assert ("safe" in state) == ("lit" in state and "shut" not in state)

    def test_a_defined_fluent_has_no_inertia(self) -> None:
        lit = after(domain_text(CART), ["lit"], ["shut_gate"])
        assert lit == {frozenset({"lit", "shut"})}

    def test_actions_that_are_impossible_together_may_occur_alone(self) -> None:
        program = translate(SMALL)
        assert after(program, ["bell"], ["push(front)"]) == {frozenset({"open(front)", "bell"})}
        assert after(program, ["bell"], ["ring"]) == {frozenset({"bell"})}
        assert after(program, ["bell"], ["push(front)", "ring"]) == frozenset()
        assert after(program, [], ["push(front)", "ring"]) == {frozenset({"open(front)", "bell"})}

    def test_an_action_that_is_impossible_beside_itself_is_impossible(self) -> None:
        """A compound action is a set: `push(back), push(back)` is `push(back)`."""
        text = SMALL + "laws\n  impossible push(D), push(back) if bell.\n"
        asked = "#show impossible/2. :- not holds(bell,0). :- not -holds(open(D),0), door(D)."
        assert shown(f"{translate(text)} {asked}") == {"impossible(push(back),0)"}
        assert after(translate(text), ["bell"], ["push(front)"])

    def test_a_fact_with_variables_is_true_of_all_that_they_range_over(self) -> None:
        beside = "statics\n  beside(door, door).\nfacts\n  beside(D, D).\n"
        text = f"{SMALL}{beside}laws\n  impossible push(D) if -beside(front, D).\n"
        assert warnings_of(translate(text)) == []
        assert after(translate(text), [], ["push(front)"])
        assert not after(translate(text), [], ["push(back)"])

    def test_effects_that_contradict_each_other_have_no_successor(self) -> None:
        assert after(translate(SMALL), [], ["push(front)", "push(back)"]) == frozenset()

    def test_the_cart_moves_as_the_world_moves_it(self) -> None:
        """Every state of the cart with every set of up to three actions."""
        program, world = domain_text(CART), world_of(load_description(CART))
        actions = world.agent_actions + world.exogenous_actions
        every = list(world.states())
        assert {frozenset(world.true_atoms(s)) for s in every} == states(program)
        compounds = [c for size in range(4) for c in combinations(actions, size)]
        for state in every:
            inertial = [a for a in world.true_atoms(state) if a != "safe"]
            for actions_now in compounds:
                expected = (
                    world.successors(state, actions_now)
                    if world.executable(state, actions_now)
                    else ()
                )
                found = after(program, inertial, actions_now)
                assert found == {frozenset(world.true_atoms(s)) for s in expected}


class TestNothingIsSmuggledIn:
    def test_a_variable_named_as_the_programs_step_is_another_variable(self) -> None:
        renamed = SMALL.replace("D", "I").replace("X", "I1").replace("Y", "I")
        for actions in (["push(front)"], ["push(back)", "ring"], ["push(back)"]):
            for state in ([], ["open(front)"], ["bell"]):
                expected = after(translate(SMALL), state, actions)
                assert after(translate(renamed), state, actions) == expected

    @pytest.mark.parametrize(
        "comment",
        [
            "%* the laws below",
            "%*",
            "% *% impossible(push(D),I).",
            "% one\rimpossible(push(front),0).",
            "% one\x0bimpossible(push(front),0).",
            "% one\u2028impossible(push(front),0).",
            "% one\x00two",
            '% #include "other.lp". #script(python)',
        ],
    )
    def test_a_comment_stays_a_comment(self, comment: str) -> None:
        above = SMALL.replace("% What actions do.", comment)
        behind = SMALL.replace("% from either side", comment)
        for text in (above, behind):
            program = translate(text)
            assert warnings_of(program) == []
            assert states(program) == states(translate(SMALL))
            assert after(program, [], ["push(front)"]) == {frozenset({"open(front)"})}
            assert after(program, ["bell"], ["push(front)", "ring"]) == frozenset()

    def test_no_name_of_a_domain_is_a_name_of_the_programs(self) -> None:
        predicates, constants = _names_of_programs()
        assert {"holds", "occurs", "step", "obs", "intended_action"} <= predicates
        assert {"n", "max_name"} <= constants
        for name in predicates:
            _refused(f"sorts\n  {name} = {{x}}.\n")
            _refused(f"sorts\n  s = {{x}}.\nstatics\n  {name}(s).\n")
        for name in constants:
            _refused(f"sorts\n  s = {{{name}}}.\n")
            _refused(f"fluents\n  inertial {name}.\n")

    @pytest.mark.parametrize(
        "name", ["start", "stop", "finish", "select", "abandon", "wait", "none", "my_goal", "not"]
    )
    def test_no_action_is_one_of_the_mind_or_of_the_environment(self, name: str) -> None:
        _refused(f"actions\n  agent {name}.\n")

    @pytest.mark.parametrize("name", ["_", "_X", "__X", "_1"])
    def test_no_name_is_a_variable_of_a_program(self, name: str) -> None:
        _refused(f"sorts\n  s = {{{name}}}.\n")

    def test_a_name_may_begin_with_an_underscore(self) -> None:
        assert states(translate("fluents\n  inertial _x.\n")) == {frozenset(), frozenset({"_x"})}


def _refused(text: str) -> None:
    with pytest.raises(SourceError):
        parse_description(text, "refused.al")


def _names_of_programs() -> tuple[set[str], set[str]]:
    """The predicates of the stories' programs that are none of the domain's, and the constants."""
    solvers = [case.program.solver() for case in (*HISTORY[-3:], *CANDIDATES[:3])]
    predicates = {
        name for solver in solvers for name, _, _ in solver.control.symbolic_atoms.signatures
    }
    texts = (translate(""), *map(theory_text, THEORIES))
    return predicates - {"side"}, set(re.findall(r"#const (\w+)", "\n".join(texts)))


def test_a_default_and_an_exception_are_told_in_one_rule_each() -> None:
    text = SMALL + "defaults\n  shut: -open(D) if -bell.\n  exception shut if D = front, bell.\n"
    program = translate(text)
    assert "default(shut(D),open(D),false) :- -holds(bell,0), door(D).\n" in program
    assert "stated_exception(shut(D)) :- D = front, holds(bell,0), door(D).\n" in program
    assert warnings_of(program) == []
    assert states(program) == states(translate(SMALL))


def test_what_nothing_derives_is_false_at_every_step() -> None:
    text = SMALL.replace("  inertial bell.\n", "  inertial bell.\n  defined draught.\n").replace(
        "  % What cannot be done.\n", "  draught if open(front), bell.\n  % What cannot be done.\n"
    )
    control = clingo.Control(["--warn=none", "0"])
    control.add("base", [], translate(text) + ":- holds(bell,0). :- holds(open(D),0).")
    control.ground()
    answers: list[set[str]] = []
    control.solve(on_model=lambda model: answers.append({*map(str, model.symbols(atoms=True))}))
    assert len(answers) == 1
    never = {
        f"-occurs({action},{i})" for action in ("push(front)", "push(back)", "ring") for i in (0, 1)
    }
    assert never | {"-holds(draught,0)", "-holds(draught,1)"} <= answers[0]
