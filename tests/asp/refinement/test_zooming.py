"""Zooming finds what a transition and a goal are about, and nothing else (Definitions 1 and 2)."""

from collections.abc import Iterator
from functools import cache
from itertools import product
from pathlib import Path

from hypothesis import given, settings
from hypothesis import strategies as st

from asp.language import (
    Action,
    Literal,
    Problems,
    Signature,
    analyse,
    ground_description,
    signature_of,
    syntax,
    variable_domains,
)
from asp.refinement import (
    CoarseDomain,
    Refinement,
    Transition,
    fine_constants,
    fine_goal,
    load_refinement,
    relevant,
    zoom,
)
from asp.translation import translate_source
from testbed.world import world_of
from tests.asp.reasoning.diagrams import warnings_of
from tests.asp.refinement.levels import level, transitions
from tests.literals import parsed

HERE = Path(__file__).parent


@cache
def of(domain: str) -> Refinement:
    if domain.startswith("L"):
        return level(domain)
    return load_refinement("office.fine" if domain == "office" else str(HERE / f"{domain}.fine"))


@cache
def acts(domain: str) -> list[Transition]:
    agent = of(domain).description.agent_actions
    return [t for t in transitions(of(domain)) if t.action in agent]


def signature(source: syntax.Source) -> Signature:
    return signature_of(source, Problems(source.file))


class TestThePaperSExample:
    """The goal is to take tb1 from office1 to the library; the robot, in the kitchen, sets out."""

    BEFORE = frozenset(
        parsed(["loc(rob1,kitchen)", "loc(tb1,office1)", "loc(tb2,office2)", "loc(cup1,office2)"])
    )
    MOVE = Transition(
        BEFORE,
        Action.parse("move(rob1,office1)"),
        BEFORE ^ {*parsed(["loc(rob1,kitchen)", "loc(rob1,office1)"])},
    )

    @property
    def constants(self) -> frozenset[str]:
        return relevant(of("assistant"), self.MOVE, parsed(["loc(tb1,library)"]))

    def test_it_is_a_transition_of_the_domain(self) -> None:
        assert self.MOVE in acts("assistant")

    def test_robot_book_and_the_two_rooms_are_relevant_and_what_the_goal_names(self) -> None:
        assert self.constants == {"rob1", "tb1", "kitchen", "office1", "library"}

    def test_without_the_goal_the_book_would_not_be(self) -> None:
        found = relevant(of("assistant"), self.MOVE, [])
        assert found == {"rob1", "kitchen", "office1"}

    def test_there_is_no_cup_and_nothing_to_do_with_one(self) -> None:
        coarse = signature(zoom(of("assistant").coarse, of("assistant"), self.constants))
        assert "cup" not in coarse.sorts
        assert "wash" not in coarse.symbols
        assert coarse.sorts["object"] == ("tb1",)
        assert coarse.sorts["place"] == ("office1", "kitchen", "library")

    def test_the_fine_constants_are_the_cells_of_the_rooms_the_robot_and_the_book(self) -> None:
        refinement = of("assistant")
        assert fine_constants(refinement, self.constants) == {
            *("c1", "c2", "c5", "c6", "c7", "c8", "rob1", "tb1")
        }
        for source in (
            zoom(refinement.weak, refinement, self.constants),
            zoom(refinement.strong, refinement, self.constants),
        ):
            fine = signature(source)
            assert "part" not in fine.sorts
            assert "fine_wash" not in fine.symbols
            assert fine.sorts["fine_thing"] == ("tb1", "rob1")
            assert fine.sorts["cell"] == ("c1", "c2", "c5", "c6", "c7", "c8")

    def test_without_an_object_there_is_no_pickup(self) -> None:
        """The move for a goal that is about the robot: D_f(T,G) has no action on objects."""
        refinement = of("assistant")
        constants = relevant(refinement, self.MOVE, parsed(["loc(rob1,office1)"]))
        fine = signature(zoom(refinement.strong, refinement, constants))
        assert {s for s, d in fine.symbols.items() if d.kind in ("agent", "exogenous")} == {
            *("fine_move", "test_fine_loc")
        }
        assert "in_hand" not in fine.symbols

    def test_the_fine_goal_is_the_next_state_as_far_as_it_is_relevant(self) -> None:
        effects, lasting = fine_goal(of("assistant"), self.MOVE, self.constants)
        assert set(effects) == {"loc(rob1,office1)", "-loc(rob1,kitchen)"}
        assert {*effects, *lasting} == {
            *("loc(rob1,office1)", "-loc(rob1,kitchen)", "-loc(rob1,library)"),
            *("loc(tb1,office1)", "-loc(tb1,kitchen)", "-loc(tb1,library)", "-in_hand(rob1,tb1)"),
        }


def rules(
    refinement: Refinement, transition: Transition, goal: list[Literal]
) -> dict[int, set[str]]:
    """What each of the five rules makes relevant, read off the definition instance by instance."""
    coarse, declared = refinement.coarse, refinement.coarse_signature
    before = {
        fluent if fluent in transition.before else fluent.complement
        for fluent in refinement.description.fluents
    }
    in_bodies = {
        literal
        for law in coarse.each(syntax.ExecutabilityCondition)
        for binding in bindings(law, declared)
        if transition.action in (said(action, binding) for action in law.actions)
        for part in law.body
        if isinstance(part, syntax.Literal)
        for literal in [said(part.atom, binding, part.positive)]
    }
    return {
        1: set(transition.action.arguments),
        2: {constant for literal in goal for constant in literal.arguments},
        3: {c for fluent in transition.before ^ transition.after for c in fluent.arguments},
        4: {constant for literal in in_bodies & before for constant in literal.arguments},
        5: {constant for literal in goal for constant in literal.arguments},
    }


def bindings(law: syntax.Statement, signature: Signature) -> Iterator[dict[str, str]]:
    domains = variable_domains(law, signature)
    return (dict(zip(domains, row, strict=True)) for row in product(*domains.values()))


def said(atom: syntax.Atom, binding: dict[str, str], positive: bool = True) -> Literal:
    values = (binding.get(term.name, term.name) for term in atom.args)
    return Literal.of(atom.name, values, positive)


DOMAINS = ["L1", "L2", "L3", "assistant", "office", "tabletop"]


@st.composite
def questions(draw: st.DrawFn) -> tuple[str, Transition, list[Literal]]:
    domain = draw(st.sampled_from(DOMAINS))
    transition = draw(st.sampled_from(acts(domain)))
    fluents = of(domain).description.fluents
    literal = st.sampled_from([*fluents, *(each.complement for each in fluents)])
    return domain, transition, draw(st.lists(literal, max_size=2))


class TestRelevance:
    @given(questions())
    @settings(max_examples=200)
    def test_it_is_the_least_set_closed_under_the_five_rules(
        self, question: tuple[str, Transition, list[Literal]]
    ) -> None:
        domain, transition, goal = question
        found = relevant(of(domain), transition, goal)
        by_rule = rules(of(domain), transition, goal)
        for number, constants in by_rule.items():
            assert constants <= found, f"rule {number}"
        for constant in found:
            assert any(constant in constants for constants in by_rule.values())

    def test_the_place_from_which_one_unlocks_is_relevant_by_an_executability_condition(
        self,
    ) -> None:
        before = frozenset(
            parsed(
                ["loc(rob1,kitchen)", "loc(book1,office1)", "loc(book2,office1)", "locked(library)"]
            )
        )
        unlock = Transition(
            before, Action.parse("unlock(rob1,library)"), before - {"locked(library)"}
        )
        unlock = Transition(before, "unlock(rob1,library)", before - {"locked(library)"})
        assert relevant(of("office"), unlock, []) == {"rob1", "library", "kitchen"}

    def test_what_is_carried_along_is_relevant_by_its_change(self) -> None:
        before = frozenset(
            parsed({"loc(rob1,room1)", "loc(object1,room1)", "in_hand(rob1,object1)"})
        )
        after = frozenset(
            parsed({"loc(rob1,room2)", "loc(object1,room2)", "in_hand(rob1,object1)"})
        )
        move = Transition(before, "move(rob1,room2)", after)
        assert relevant(level("L2"), move, []) == {"rob1", "object1", "room1", "room2"}


class TestZoomedDescriptions:
    @given(questions())
    @settings(max_examples=60)
    def test_the_restricted_transition_is_one_of_the_zoomed_coarse_description(
        self, question: tuple[str, Transition, list[Literal]]
    ) -> None:
        domain, transition, goal = question
        constants = relevant(of(domain), transition, goal)
        source = zoom(of(domain).coarse, of(domain), constants)
        world = world_of(ground_description(source, signature(source), "zoomed"))
        inertial = frozenset(world.description.inertial)
        before, after = (inertial & s for s in (transition.before, transition.after))
        found = {
            inertial.intersection(world.true_atoms(successor))
            for state in world.states()
            if inertial.intersection(world.true_atoms(state)) == before
            for successor in world.successors(state, [transition.action])
        }
        assert found == {after}

    @given(questions())
    @settings(max_examples=60)
    def test_the_zoomed_fine_description_is_about_the_components_and_nothing_else(
        self, question: tuple[str, Transition, list[Literal]]
    ) -> None:
        domain, transition, goal = question
        refinement = of(domain)
        constants = relevant(refinement, transition, goal)
        kept = constants | fine_constants(refinement, constants)
        whole = signature(refinement.strong)
        zoomed = signature(zoom(refinement.strong, refinement, constants))
        for sort, members in whole.sorts.items():
            left = tuple(m for m in members if m in kept or sort == "outcome")
            assert zoomed.sorts.get(sort, ()) == left
        for symbol, declaration in whole.symbols.items():
            written = all(zoomed.sorts.get(sort.name) for sort in declaration.sorts)
            assert (symbol in zoomed.symbols) == written

    @given(questions())
    @settings(max_examples=30)
    def test_clingo_accepts_the_zoomed_programs_without_a_warning(
        self, question: tuple[str, Transition, list[Literal]]
    ) -> None:
        domain, transition, goal = question
        refinement = of(domain)
        constants = relevant(refinement, transition, goal)
        for source in (
            zoom(refinement.coarse, refinement, constants),
            zoom(refinement.weak, refinement, constants),
            zoom(refinement.strong, refinement, constants),
        ):
            assert warnings_of(translate_source(source, signature(source))) == []

    @given(questions())
    @settings(max_examples=60)
    def test_a_comment_stays_with_what_it_was_said_of(
        self, question: tuple[str, Transition, list[Literal]]
    ) -> None:
        domain, transition, goal = question
        refinement = of(domain)
        source = zoom(refinement.strong, refinement, relevant(refinement, transition, goal))
        assert set(pairs(source)) <= set(pairs(refinement.strong))


def pairs(source: syntax.Source) -> list[tuple[str, str]]:
    """The head of each law's rule with the comment behind it."""
    program = translate_source(source, signature(source))
    lines = [line.split("  % ") for line in program.split("\n") if ".  % " in line]
    return [(line[0].partition(" :- ")[0], line[1]) for line in lines]


class TestFineGoals:
    @given(questions())
    @settings(max_examples=100)
    def test_it_says_all_that_is_so_afterwards_of_relevant_constants(
        self, question: tuple[str, Transition, list[Literal]]
    ) -> None:
        domain, transition, goal = question
        constants = relevant(of(domain), transition, goal)
        effects, lasting = fine_goal(of(domain), transition, constants)
        found = {*effects, *lasting}
        for fluent in of(domain).description.inertial:
            if constants.issuperset(fluent.arguments):
                assert (fluent in found) == (fluent in transition.after)
                assert (fluent.complement in found) == (fluent not in transition.after)
            else:
                assert not {fluent, fluent.complement}.intersection(found)

    @given(questions())
    @settings(max_examples=100)
    def test_every_change_of_an_inertial_fluent_is_an_effect(
        self, question: tuple[str, Transition, list[Literal]]
    ) -> None:
        domain, transition, goal = question
        refinement = of(domain)
        constants = relevant(refinement, transition, goal)
        changed = {
            fluent
            for fluent in transition.before ^ transition.after
            if fluent in refinement.description.inertial
        }
        effects, _ = fine_goal(refinement, transition, constants)
        assert {each.atom for each in effects} == changed
        assert all(e.is_positive == (e.atom in transition.after) for e in effects)


def test_a_description_that_nothing_refines_has_the_same_relevant_constants() -> None:
    alone = CoarseDomain(*analyse((HERE / "tabletop.al").read_text(encoding="utf-8")))
    goal = parsed(["delivered(block2)"])
    for transition in acts("tabletop"):
        assert relevant(alone, transition, goal) == relevant(of("tabletop"), transition, goal)
    assert relevant(alone, None, goal) == {"block2"}
