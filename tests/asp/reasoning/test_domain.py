"""Domains by themselves, against brute force in the world and over the translated program."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from functools import cache
from itertools import chain, combinations, product
from pathlib import Path
from random import Random

import pytest

import asp
from asp.reasoning.diagnosis import InconsistentHistoryError
from asp.reasoning.domain import Domain, Step
from asp.translation import translate
from testbed.world import World, world_of
from tests.asp.reasoning import diagrams
from tests.greenhouse import GREENHOUSE

CART = (Path(__file__).parent / "cart.al").read_text(encoding="utf-8")
SWITCHES = """\
fluents
  inertial p.
  inertial q.
  inertial r.
actions
  agent doit.
  agent fixp.
  exogenous e.
laws
  doit causes r.
  -p if r, q.
  -q if r, p.
  fixp causes p.
  e causes r.
"""
"""`doit` and `e` have two outcomes where p and q hold."""
TEXTS = {"cart": CART, "greenhouse": GREENHOUSE, "switches": SWITCHES}
LONGEST = 4
Events = frozenset[tuple[int, str]]


@cache
def _domain(name: str) -> Domain:
    return Domain(TEXTS[name], f"{name}.al")


@cache
def _world(name: str) -> World:
    return world_of(_domain(name).description)


def _subsets(actions: Iterable[str]) -> Iterator[tuple[str, ...]]:
    every = tuple(actions)
    return chain.from_iterable(combinations(every, size) for size in range(len(every) + 1))


def _true(name: str, state: int) -> frozenset[str]:
    return frozenset(_world(name).true_atoms(state))


@pytest.mark.parametrize("name", TEXTS)
def test_a_diagram_has_every_state_and_every_transition_by_one_action(name: str) -> None:
    world, diagram = _world(name), _domain(name).diagram()
    assert len(set(diagram.states)) == len(diagram.states)
    assert set(diagram.states) == diagrams.states(translate(TEXTS[name], f"{name}.al"))
    expected = {
        (_true(name, state), action, _true(name, after))
        for state in world.states()
        for action in (*world.agent_actions, *world.exogenous_actions)
        for after in world.successors(state, [action])
    }
    found = list(diagram.transitions)
    assert len(found) == len(expected)
    assert set(found) == expected


@pytest.mark.parametrize("name", TEXTS)
def test_successors_are_those_of_every_compound_action(name: str) -> None:
    world, random = _world(name), Random(1)
    actions = (*world.agent_actions, *world.exogenous_actions)
    compounds = [c for c in _subsets(actions) if len(c) <= 3]
    for state in world.states():
        for compound in random.sample(compounds, min(12, len(compounds))):
            found = _domain(name).successors(_true(name, state), compound)
            assert len(found) == len(set(found))
            assert set(found) == {_true(name, s) for s in world.successors(state, compound)}


def test_an_action_with_several_outcomes_has_several_successors() -> None:
    found = _domain("switches").successors("p, q", "doit")
    program = translate(SWITCHES, "switches.al")
    assert len(found) == 2
    assert set(found) == diagrams.after(program, ["p", "q"], ["doit"])


def _first_plan(name: str, state: int, goal: Iterable[str]) -> tuple[str, ...] | None:
    """The first of all sequences of actions, shorter ones first, some outcome of which fits."""
    world, wanted = _world(name), _parsed(goal)
    for length in range(LONGEST + 1):
        for plan in product(world.agent_actions, repeat=length):
            reached = {state}
            for action in plan:
                reached = {s for each in reached for s in world.successors(each, [action])}
            if any(world.satisfies(each, wanted) for each in reached):
                return plan
    return None


@pytest.mark.parametrize("name", TEXTS)
def test_a_plan_is_the_first_shortest_one(name: str) -> None:
    world, random, lengths = _world(name), Random(2), set()
    literals = [sign + fluent for fluent in world.fluents for sign in ("", "-")]
    pairs = combinations(literals, 2)
    goals = [two for two in pairs if two[0].lstrip("-") != two[1].lstrip("-")]
    for state, goal in random.sample([*product(world.states(), goals)], 30):
        expected = _first_plan(name, state, goal)
        assert _domain(name).plan(_true(name, state), goal, LONGEST) == expected
        lengths.add(None if expected is None else len(expected))
    assert {None, 0, 1, 2} <= lengths


def test_a_plan_that_is_longer_than_the_limit_is_none() -> None:
    cart = _domain("cart")
    assert cart.plan("at(left), shut", "at(right)") == ("open", "go(right)")
    assert cart.plan("at(left), shut", "at(right)", limit=1) is None


def _attempts(name: str) -> tuple[str | None, ...]:
    return None, *_world(name).agent_actions


def _told(name: str, random: Random) -> list[Step]:
    """Something that nobody need have seen: a history that may be inconsistent."""
    world = _world(name)
    literals = [sign + fluent for fluent in world.fluents for sign in ("", "-")]
    steps = []
    for _ in range(random.choice([2, 3])):
        first, second = random.sample(literals, 2)
        observed = [first] if first.lstrip("-") == second.lstrip("-") else [first, second]
        attempted = random.choice(_attempts(name))
        reported = random.sample(world.exogenous_actions, random.choice([0, 0, 1]))
        steps.append(Step(observed, attempted, random.random() < 0.6, reported))
    return steps


def _smallest(name: str, steps: list[Step]) -> set[tuple[Events, Events]]:
    """What is assumed by the smallest explanations: of all there are, state after state."""
    world = _world(name)
    events = world.exogenous_actions
    found: dict[int, set[tuple[Events, Events]]] = {
        state: {(frozenset(), frozenset())} for state in world.initial_states()
    }
    acting = [bool(step.attempted or step.reported) for step in steps]
    for time, step in enumerate(steps):
        found = {s: e for s, e in found.items() if world.satisfies(s, _parsed(step.observed))}
        if time == len(steps) - 1 and not acting[-1]:
            break
        after: dict[int, set[tuple[Events, Events]]] = {}
        others = [event for event in events if event not in step.reported]
        for state, assumed in found.items():
            own = [step.attempted] if step.attempted else []
            took_effect = bool(own) and world.executable(state, own)
            if own and took_effect != step.took_effect:
                continue
            for unobserved, distrusted in product(_subsets(others), _subsets(step.reported)):
                happened = [*unobserved, *(e for e in step.reported if e not in distrusted)]
                for reached in world.successors(state, [*happened, *(own if took_effect else [])]):
                    after.setdefault(reached, set()).update(
                        (
                            before | {(time, event) for event in unobserved},
                            wrong | {(time, event) for event in distrusted},
                        )
                        for before, wrong in assumed
                        if len(before) + len(wrong) + len(unobserved) + len(distrusted) <= 4
                    )
        found = after
    every = set().union(*found.values())
    least = min((len(unobserved) + len(wrong) for unobserved, wrong in every), default=0)
    return {each for each in every if sum(map(len, each)) == least}


def _parsed(literals: Iterable[str]) -> list[asp.language.Literal]:
    return [asp.language.Literal.parse(each) for each in literals]


@pytest.mark.parametrize("name", ["cart", "switches"])
def test_explanations_are_the_smallest_of_all_there_are(name: str) -> None:
    random, domain, sizes = Random(3), _domain(name), set()
    for _ in range(50):
        steps = _told(name, random)
        expected = _smallest(name, steps)
        if not expected:
            with pytest.raises(InconsistentHistoryError):
                domain.explain(steps)
            sizes.add(None)
            continue
        every, more = domain.explanations(steps, most=1000)
        found = [(frozenset(each.unobserved), frozenset(each.distrusted)) for each in every]
        assert not more
        assert set(found) == expected
        assert len(found) == len(expected)
        first = domain.explain(steps)
        assert (frozenset(first.unobserved), frozenset(first.distrusted)) in expected
        sizes.add(first.size)
    assert {None, 0, 1} <= sizes


def test_a_goal_that_was_seen_not_to_hold_is_explained() -> None:
    steps = [Step("at(left), -shut, lit"), Step(goal=False)]
    found = _domain("cart").explain(steps, "at(left), lit")
    assert found.unobserved == ((0, "push(right)"),)
    assert _domain("cart").explain([steps[0], Step(goal=True)], "at(left), lit").size == 0


def test_a_goal_that_no_state_has_never_holds() -> None:
    start, goal = Step("at(left), -shut, lit"), "at(left), at(right)"
    assert _domain("cart").explain([start, Step(goal=False)], goal).size == 0
    every, more = _domain("cart").explanations([start, Step(goal=False)], goal)
    assert ([each.size for each in every], more) == ([0], False)
    with pytest.raises(InconsistentHistoryError):
        _domain("cart").explain([start, Step(goal=True)], goal)


@pytest.mark.parametrize(
    "start",
    [
        pytest.param("at(left), at(right), -shut, lit, safe", id="no state"),
        pytest.param("at(left), -at(right), -shut, lit, -safe", id="it follows that it is safe"),
        pytest.param("-at(left), -at(right), -shut, lit, safe", id="no initial state"),
    ],
)
@pytest.mark.parametrize(
    "rest", [[], [Step()], [Step(attempted="open", took_effect=False), Step()]]
)
def test_what_cannot_have_been_at_the_start_is_not_explained(start: str, rest: list[Step]) -> None:
    cart = Domain(f"{CART}initially\n  at(S) for some S.\n", "cart.al")
    with pytest.raises(InconsistentHistoryError):
        cart.explain([Step(start), *rest])


def test_what_follows_need_not_be_given() -> None:
    assert _domain("cart").state("at(left), lit, -shut") == {"at(left)", "lit", "safe"}
    assert _domain("cart").state(["lit", "shut"]) == {"lit", "shut"}
    every = _domain("cart").diagram().states
    assert [_domain("cart").state(each) for each in every] == list(every)


@pytest.mark.parametrize(
    ("asked", "named"),
    [
        (lambda d: d.state("at(left), at(right)"), "at(right)"),
        (lambda d: d.state("safe"), "safe"),
        (lambda d: d.state("lit, -lit"), "lit"),
        (lambda d: d.plan("lit", "at(lef)"), "left"),
        (lambda d: d.plan("lit", "at(left"), "at(left"),
        (lambda d: d.plan("lit", "at(left)", plans="conform"), "conform"),
        (lambda d: d.successors("lit", "lit"), "action"),
        (lambda d: d.successors("lit", "-open"), "-open"),
        (lambda d: d.explain([Step("lit"), Step(attempted="push(left)")]), "history.1.attempted"),
        (lambda d: d.explain([Step("lit", attempted="open, go(left)")]), "history.0.attempted"),
        (lambda d: d.explain([Step("lit", reported=["open"])]), "history.0.reported"),
        (lambda d: d.explain([Step("lit, at")]), "history.0.observed"),
        (lambda d: d.diagram(most=5), "5"),
    ],
)
def test_what_the_domain_does_not_have_is_refused_in_one_line(asked, named: str) -> None:  # type: ignore[no-untyped-def]
    with pytest.raises(asp.DomainError) as refused:
        asked(_domain("cart"))
    (line,) = str(refused.value).splitlines()
    assert named in line


def test_a_domain_is_loaded_by_path_and_by_name(tmp_path: Path) -> None:
    (tmp_path / "cart.al").write_text(CART, encoding="utf-8")
    assert asp.load(str(tmp_path / "cart.al")).plan("at(left), shut", "-shut") == ("open",)
    assert asp.load("library").description.defaults
