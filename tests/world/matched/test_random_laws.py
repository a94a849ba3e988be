"""Random laws with variables: the world that matches them against the world of their instances."""

from itertools import chain, combinations, product

from hypothesis import assume, event, example, given, settings
from hypothesis import strategies as st

from asp import SourceError, parse_description
from asp.language import analyse
from testbed.world import StateError, World, world_of
from tests.world.test_world_random import CLOSED_WORLD, TOGETHER, UNDETERMINED
from tests.world.test_world_random import HEADER as PROPOSITIONS
from tests.world.test_world_random import laws as propositional

HEADER = """\
sorts
  some  = {c1, c2}.
  thing = {c3} + some.
statics
  near(thing, thing).  odd(thing).
fluents
  inertial at(some, thing).
  inertial on(thing).
  defined  lit(thing).
actions
  agent a(some, thing).  exogenous e(thing).
laws
"""
FOOTER = """\
facts
  near(c1, c2).  near(c2, c2).  near(c2, c3).  odd(c3).
"""
VARIABLES = ("X", "Y", "Z", "c2")


def atoms(*forms: tuple[str, int]) -> st.SearchStrategy[str]:
    def of(form: tuple[str, int]) -> st.SearchStrategy[str]:
        terms = st.tuples(*[st.sampled_from(VARIABLES)] * form[1])
        return terms.map(lambda values: f"{form[0]}({', '.join(values)})")

    return st.sampled_from(forms).flatmap(of)


def signed(strategy: st.SearchStrategy[str]) -> st.SearchStrategy[str]:
    return st.tuples(st.sampled_from(("", "-")), strategy).map("".join)


INERTIAL = (("at", 2), ("on", 1))
CONDITIONS = st.one_of(
    signed(atoms(*INERTIAL, ("lit", 1))),
    signed(atoms(("near", 2), ("odd", 1))),
    st.sampled_from(["X != Y", "Y = Z", "Z != c2", "some(X)", "X != Z"]),
)
ACTIONS = atoms(("a", 2), ("e", 1))


@st.composite
def laws(draw: st.DrawFn) -> str:
    body = draw(st.lists(CONDITIONS, max_size=3, unique=True))
    condition = f" if {', '.join(body)}" if body else ""
    kind = draw(st.sampled_from(["causes", "causes", "inertial", "inertial", "defined", "not"]))
    if kind == "causes":
        return f"{draw(ACTIONS)} causes {draw(signed(atoms(*INERTIAL)))}{condition}."
    if kind == "not":
        return (
            f"impossible {', '.join(draw(st.lists(ACTIONS, min_size=1, max_size=2)))}{condition}."
        )
    head = draw(signed(atoms(*INERTIAL)) if kind == "inertial" else atoms(("lit", 1)))
    return f"{head}{condition}."


# What only one of two things can be at, what goes along, and what is derived from what is derived.
PLACES = [
    "a(X, Y) causes at(X, Y).",
    "-at(X, Y) if at(X, Z), Y != Z.",
    "at(X, Z) if at(Y, Z), near(X, Y), on(X).",
    "lit(Y) if at(X, Y).",
    "lit(X) if lit(Y), near(X, Y).",
    "-on(X) if lit(X), odd(X).",
    "impossible a(X, Y), e(Z) if at(X, Z), -near(Y, Z).",
    "e(X) causes on(Y) if near(X, Y).",
]
EVERYWHERE = ["e(X) causes at(Y, Z) if -near(Y, Z).", "on(X) if -lit(X), -at(Y, X)."]


# Nothing has to happen for lit and on to fall together.
WAVERING = ["lit(X) if on(X).", "-on(X) if -lit(X).", "e(X) causes on(X)."]


@example(WAVERING)
@example(PLACES)
@example(EVERYWHERE)
@settings(max_examples=60)
@given(st.lists(laws(), min_size=2, max_size=8))
def test_laws_with_variables(drawn: list[str]) -> None:
    agree(HEADER + "\n".join(f"  {law}" for law in drawn) + "\n" + FOOTER)


@example(["q if f.", "-f if -q."])
@example(["p if f.", "q if p.", "k if -q.", "-f if k.", "a causes g."])
@example(UNDETERMINED)
@example(CLOSED_WORLD)
@example(TOGETHER)
@settings(max_examples=50)
@given(st.lists(propositional(), min_size=1, max_size=9))
def test_laws_without_variables(drawn: list[str]) -> None:
    agree(PROPOSITIONS + "\n".join(f"  {law}" for law in drawn) + "\n")


def agree(text: str) -> None:
    """The two worlds have the same states, transitions, refusals and readings of literals."""
    try:
        ground = world_of(parse_description(text))
    except SourceError as error:
        assume("defined through its own negation" not in str(error))
        assume("bound by nothing" not in str(error))
        assume("no constant fits" not in str(error))
        raise
    matched = world_of(analyse(text)[0])
    assert matched.fluents == ground.fluents
    states = list(ground.states())
    every = range(1 << len(ground.fluents))
    some = every[:: max(1, len(every) // 256)]
    assert [s for s in some if matched.is_state(s)] == [s for s in some if ground.is_state(s)]
    assert all(matched.is_state(s) for s in states)
    for literals in [*map(ground.true_atoms, states[:20]), *map(ground.true_atoms, some[:20])]:
        assert read(matched, literals) == read(ground, literals)
    for state, literal in product(states[::7][:5], ground.literals(states[-1]) if states else ()):
        assert matched.adjusted(state, [literal]) == ground.adjusted(state, [literal])
    assert bare(matched) == bare(ground)
    actions = (*ground.agent_actions, *ground.exogenous_actions)
    compounds = [c for n in range(3) for c in combinations(actions, n)]
    asked = chain.from_iterable(((s, c) for c in compounds[:60]) for s in states[::5][:25])
    outcomes = {0: 0}
    for state, compound in asked:
        after = ground.successors(state, compound)
        assert matched.successors(state, compound) == after
        refusals = matched.why_not(state, compound), ground.why_not(state, compound)
        assert [r is None for r in refusals] == [bool(after)] * 2
        outcomes[len(after)] = outcomes.get(len(after), 0) + 1
    event(f"most outcomes {max(outcomes)}")


def read(world: World, literals: tuple[str, ...]) -> int | None:
    try:
        return world.state(literals)
    except StateError:
        return None


def bare(world: World) -> int | None:
    try:
        return world.bare()
    except StateError:
        return None
