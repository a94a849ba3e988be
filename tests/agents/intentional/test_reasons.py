"""Why the robot decides as it does, against what the world and the plain theory say."""

from itertools import combinations

import clingo
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from agents.intentional import IntentionalRobot
from agents.intentional.activities import History
from agents.intentional.reasoners import IncrementalReasoner, ReferenceReasoner
from agents.intentional.reasons import IntentionalReasons
from agents.shared import sessions_of
from asp.language import Literal
from asp.reasoning import knowledge
from asp.reasoning.diagnosis import SELECT, Diagnosis, Explanation, Happening
from asp.reasoning.planning import IncrementalPlanner, Reachability
from asp.solving import Limits, ground, select, theory
from testbed.protocol import Decision, Event, Percept, Task
from testbed.world import World, world_of
from tests.agents.intentional.lives import BOTH_IN_THE_LIBRARY, DOMAIN, SOURCE, WORLD, Wish, live
from tests.agents.intentional.test_reports import CART
from tests.literals import parsed

OFFICE = knowledge(DOMAIN, SOURCE)
START = WORLD.state(parsed(["loc(rob1,office2)", "in_hand(rob1,book1)", "loc(book2,kitchen)"]))
LITERALS = [literal for fluent in WORLD.fluents for literal in (fluent, fluent.complement)]


def _contrary(decision: Decision) -> list[tuple[int, str, str]]:
    return [(c.step, c.observed, c.believed) for c in decision.trace.contradictions]


def test_a_book_that_is_gone() -> None:
    """Someone takes book2 out of the kitchen while the robot goes there."""
    life = live(IntentionalRobot(), START, wishes={2: Wish(0)})
    first, going, stop, again, *_, last = life.decisions
    assert first.trace.reason == "no activity for the goal; 7 actions achieve it, none fewer"
    assert going.trace.reason == "activity 1 still reaches the goal, by step 9"
    assert _contrary(stop) == [(3, "-loc(book2,kitchen)", "loc(book2,kitchen)")]
    assert stop.trace.explanation is not None
    assert stop.trace.explanation.unobserved == [Event(step=2, action="exo_move(book2,office1)")]
    # Three rooms are left, at each of two steps; one of these is what the robot adopts.
    assert len(stop.trace.alternatives) in (2, 3, 4, 5)
    assert stop.trace.explanation not in stop.trace.alternatives
    assert not stop.trace.more_alternatives
    # move, put_down, move at steps 3 to 5, and then the book is not there.
    assert stop.trace.futile_at == 6
    assert stop.trace.reason == (
        "futile: pickup(rob1,book2) is impossible at step 6 "
        "with loc(book2,office1), loc(rob1,kitchen)"
    )
    assert again.trace.mental == "start(2)"
    assert last.trace.reason == "the goal holds"


def test_a_plan_whose_end_misses_the_goal() -> None:
    """The book is put where it should be, and another one is not there any more."""
    goal = parsed(["loc(book1,kitchen)", "loc(book2,kitchen)", "-in_hand(rob1,book1)"])
    for wish in range(4):
        life = live(IntentionalRobot(), START, goal, {2: Wish(wish)})
        stops = [d for d in life.decisions if d.trace.mental == "stop(1)"]
        if stops:
            (stop,) = stops
            break
    assert stop.trace.futile_at == stop.step + 1  # put_down is what is left
    assert "violates the goal with -loc(book2,kitchen)" in stop.trace.reason


def test_news_that_cannot_be_true_contradicts_what_makes_it_impossible() -> None:
    history = History()
    history.observe(WORLD.literals(START), 0)
    history.happened(SELECT, True, 0)
    history.step = 2
    history.happened(Literal.parse("exo_move(book1,office1)"), True, 1)
    reasons = IntentionalReasons(OFFICE, TASK)
    (found,) = reasons.contradictions(history, Explanation(), frozenset(WORLD.true_atoms(START)), 1)
    assert (found.step, found.observed, found.believed) == (
        1,
        "hpd(exo_move(book1,office1))",
        "impossible(exo_move(book1,office1))",
    )


@settings(max_examples=8)
@given(
    steps=st.integers(1, 4),
    seen=st.sampled_from(
        [
            parsed(["loc(book2,office1)"]),
            parsed(["-loc(book2,kitchen)"]),
            parsed(["loc(book2,library)", "locked(library)"]),
        ]
    ),
    told=st.booleans(),
)
def test_alternatives_are_all_explanations_of_the_plain_theory(
    steps: int, seen: tuple[str, ...], told: bool
) -> None:
    history = History()
    history.observe(WORLD.literals(START), 0)
    history.happened(SELECT, True, 0)
    history.step = steps
    if told:
        history.happened(Literal.parse("exo_move(book2,office2)"), True, 1)
    history.observe(seen, steps)
    plain = _smallest_in_the_plain_theory(history)
    if plain is None:
        return
    one = next(iter(sorted(plain, key=str)))
    others, more = IntentionalReasons(OFFICE, TASK).alternatives(
        history, Diagnosis(_diagnosis(one))
    )
    found = {(frozenset(_pairs(o.unobserved)), frozenset(_pairs(o.distrusted))) for o in others}
    assert not more
    assert len(others) == len(found)
    assert found == plain - {one}


Pairs = frozenset[tuple[int, str]]


def _pairs(events: list[Event]) -> list[tuple[int, str]]:
    return [(event.step, event.action) for event in events]


def _diagnosis(one: tuple[Pairs, Pairs]) -> Explanation:
    unobserved, distrusted = (
        tuple(Happening(step, action) for step, action in sorted(pairs)) for pairs in one
    )
    return Explanation(unobserved, distrusted)


def _smallest_in_the_plain_theory(history: History) -> set[tuple[Pairs, Pairs]] | None:
    """By enumeration of every answer set, whatever it assumes, up to four assumptions."""
    texts = [OFFICE.program, *map(theory, ("history", "defaults", "diagnosis"))]
    given = [*history.facts(), *OFFICE.ranks, *OFFICE.start]
    given.append(clingo.Function("explaining", [clingo.Number(history.step)]))
    # Nothing happens while the goal is selected (16).
    texts.append(":- occurs(E,0), exogenous_action(E).")
    for most in range(5):
        constants = {"n": history.step, "max_unobserved": most}
        control = ground(texts, constants, given)
        control.configuration.solve.models = 0  # type: ignore[union-attr]
        found = set()
        with control.solve(yield_=True) as handle:
            for model in handle:
                shown = model.symbols(shown=True)
                unobserved, distrusted = (
                    frozenset((s.number, str(a)) for a, s in select(shown, name, 2))
                    for name in ("unobserved", "distrusted")
                )
                found.add((unobserved, distrusted))
        if found:
            return found
    return None


@pytest.mark.parametrize("reasoner", [IncrementalReasoner, ReferenceReasoner])
def test_no_more_time_than_for_a_decision_is_spent_on_alternatives(
    reasoner: type[IncrementalReasoner] | type[ReferenceReasoner],
) -> None:
    history = History()
    history.observe(WORLD.literals(START), 0)
    history.happened(SELECT, True, 0)
    history.step = 3
    history.observe(parsed(["-loc(book2,kitchen)"]), 3)
    explained = reasoner(OFFICE, BOTH_IN_THE_LIBRARY, 20).diagnose(history, Explanation())
    assert IntentionalReasons(OFFICE, TASK).alternatives(history, explained)[0]
    hurried = IntentionalReasons(OFFICE, _task([*BOTH_IN_THE_LIBRARY], 20, decision_s=0))
    assert hurried.alternatives(history, explained) == ([], True)


def test_more_alternatives_than_are_listed_are_said_to_be_there() -> None:
    history = History()
    history.observe(WORLD.literals(START), 0)
    history.happened(SELECT, True, 0)
    history.step = 30
    history.observe(parsed(["loc(book2,office1)"]), 30)
    diagnosis = Explanation((Happening(29, Literal.parse("exo_move(book2,office1)")),))
    others, more = IntentionalReasons(OFFICE, TASK).alternatives(history, Diagnosis(diagnosis))
    assert more
    assert 19 <= len(others) <= 20


def _reachable(world: World, start: int) -> set[int]:
    found, left = {start}, [start]
    while left:
        state = left.pop()
        for action in world.agent_actions:
            new = set(world.successors(state, (action,))) - found
            found |= new
            left += new
    return found


@settings(max_examples=30)
@given(
    start=st.sampled_from(list(WORLD.initial_states())),
    goal=st.lists(st.sampled_from(LITERALS), min_size=1, max_size=3),
)
def test_out_of_reach_is_what_no_search_finds(start: int, goal: list[str]) -> None:
    expected = any(WORLD.satisfies(state, goal) for state in _reachable(WORLD, start))
    found = sessions_of(OFFICE).reach.reachable(frozenset(WORLD.true_atoms(start)), tuple(goal))
    assert found is expected


def test_nor_where_some_fluents_are_defined() -> None:
    world, reach = world_of(CART.description), sessions_of(CART).reach
    literals = [literal for fluent in world.fluents for literal in (fluent, fluent.complement)]
    for start in world.initial_states():
        reachable = _reachable(world, start)
        for goal in combinations(literals, 2):
            expected = any(world.satisfies(state, goal) for state in reachable)
            found = reach.reachable(frozenset(world.true_atoms(start)), goal)
            assert found is expected, (world.true_atoms(start), goal)


@pytest.mark.parametrize(
    ("goal", "provable"),
    [
        (("shut",), True),  # only others shut the gate
        (parsed(["at(left)", "at(right)"]), True),  # no state has the cart on both sides
        (("at(right)", "lit"), False),  # achievable
        (("at(right)", "safe"), False),
    ],
)
def test_where_states_are_too_many_to_look_at_there_are_shorter_proofs(
    goal: tuple[str, ...], provable: bool, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("asp.reasoning.planning.reachability._MOST_STATES", 0)
    plans = IncrementalPlanner(CART.description.source, "cart.al")
    reach = Reachability(CART.description, sessions_of(CART).transitions, plans)
    assert (reach.reachable(frozenset(parsed(["at(left)"])), parsed(goal)) is False) is provable


def test_what_holds_by_definition_may_cease_to(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("asp.reasoning.planning.reachability._MOST_STATES", 0)
    moved = knowledge("cart", CART.description.source.replace("if lit, -shut", "if at(left)"))
    plans = IncrementalPlanner(moved.description.source, "cart.al")
    reach = Reachability(moved.description, sessions_of(moved).transitions, plans)
    assert reach.reachable(frozenset(parsed(["at(left)", "safe"])), parsed(["-safe"])) is not False


@pytest.mark.parametrize(
    ("goal", "limit", "reason"),
    [
        (
            parsed(["in_hand(rob1,book1)", "in_hand(rob1,book2)"]),
            20,
            "out of reach: no plan of any length",
        ),
        (parsed(["loc(book2,office1)"]), 3, "no plan of at most 3 actions achieves the goal"),
    ],
)
def test_giving_up_says_whether_it_is_the_limit(goal: list[str], limit: int, reason: str) -> None:
    decision = _first_decision(IntentionalRobot(), goal, limit)
    assert decision.action == "finish"
    assert not decision.believes_goal
    assert reason in decision.trace.reason


def test_where_the_time_runs_out_the_robot_waits_and_goes_on() -> None:
    robot = IntentionalRobot()
    waiting = _first_decision(robot, list(BOTH_IN_THE_LIBRARY), 20, decision_s=1e-9)
    assert (waiting.action, waiting.trace.intention) == ("wait", None)
    assert waiting.trace.reason == "the time for a decision ran out"
    robot._limits = Limits()
    decision = robot.act(_percept(2))
    assert decision.trace.mental == "start(1)"
    assert len(decision.trace.plan) == 7
    assert robot.act(_percept(3)).action == decision.trace.plan[0]


def _task(goal: list[str], limit: int, decision_s: float | None) -> Task:
    return Task(
        trial="t",
        robot="intentional",
        domain=DOMAIN,
        source=SOURCE,
        goal=goal,
        initial=list(WORLD.literals(START)),
        plan_limit=limit,
        seed=0,
        decision_s=decision_s,
    )


TASK = _task([*BOTH_IN_THE_LIBRARY], 20, None)


def _percept(step: int) -> Percept:
    return Percept(trial="t", step=step, visible=list(WORLD.visible(START, "rob1")))


def _first_decision(
    robot: IntentionalRobot, goal: list[str], limit: int, decision_s: float | None = None
) -> Decision:
    robot.begin(_task(goal, limit, decision_s))
    return robot.act(_percept(1))
