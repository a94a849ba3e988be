"""Random small descriptions: the compiled world against the program, every compound action.

They have what the office has not: defined fluents, laws with several conditions, actions that
are impossible only together, outcomes that are not determined, and states without a successor.
"""

from itertools import chain, combinations

from hypothesis import assume, event, example, given, settings
from hypothesis import strategies as st

from asp import SourceError, parse_description
from asp.translation import translate
from testbed.world import World, world_of
from tests.world import diagram

INERTIAL, DEFINED, ACTIONS = ("f", "g", "k", "h"), ("p", "q"), ("a", "b", "e")
HEADER = """\
sorts
  thing = {it}.
fluents
  inertial f.  inertial g.  inertial k.  inertial h(thing).
  defined p.   defined q.
actions
  agent a.  agent b.  exogenous e.
laws
"""


def signed(fluents: tuple[str, ...]) -> st.SearchStrategy[str]:
    texts = ["h(it)" if name == "h" else name for name in fluents]
    return st.sampled_from([sign + text for text in texts for sign in ("", "-")])


@st.composite
def laws(draw: st.DrawFn) -> str:
    body = draw(st.lists(signed(INERTIAL + DEFINED), max_size=2, unique=True))
    condition = f" if {', '.join(body)}" if body else ""
    kind = draw(st.sampled_from(["causes", "causes", "inertial", "defined", "impossible"]))
    if kind == "causes":
        return f"{draw(st.sampled_from(ACTIONS))} causes {draw(signed(INERTIAL))}{condition}."
    if kind == "impossible":
        actions = draw(st.lists(st.sampled_from(ACTIONS), min_size=1, max_size=2, unique=True))
        return f"impossible {', '.join(actions)}{condition}."
    head = draw(signed(INERTIAL) if kind == "inertial" else st.sampled_from(DEFINED))
    return f"{head}{condition}."


# With h, f excludes g and g excludes k: f and k stay, or g alone, and nothing says which.
UNDETERMINED = [
    "a causes h(it).",
    *("-f if g, h(it).", "-g if f, h(it).", "-g if k, h(it).", "-k if g, h(it)."),
]
# p is false as soon as nothing derives it, and that has consequences.
CLOSED_WORLD = ["a causes -g.", "p if g.", "q if -p, h(it).", "f if -p.", "-f if g, q."]
TOGETHER = ["a causes f.", "b causes -f.", "e causes g.", "impossible a, e if k."]


@example(UNDETERMINED)
@example(CLOSED_WORLD)
@example(TOGETHER)
@settings(max_examples=120)
@given(st.lists(laws(), min_size=1, max_size=9))
def test_a_random_world_is_the_programs(drawn: list[str]) -> None:
    text = HEADER + "\n".join(f"  {law}" for law in drawn) + "\n"
    try:
        world = world_of(parse_description(text))
    except SourceError as error:  # a fluent defined through its own negation
        assume("defined through its own negation" not in str(error))
        raise
    program = translate(text)
    assert states(world) == diagram.states(program)
    found = diagram.transitions(program, diagram.ANY_COMPOUND)
    assert transitions(world) == set(found)
    outcomes = {(before, compound) for before, compound, _ in found}
    event("several outcomes" if len(outcomes) < len(found) else "one outcome")


def states(world: World) -> set[diagram.Atoms]:
    return {frozenset(world.true_atoms(state)) for state in world.states()}


def transitions(world: World) -> set[diagram.Transition]:
    actions = (*world.agent_actions, *world.exogenous_actions)
    subsets = chain.from_iterable(combinations(actions, n) for n in range(len(actions) + 1))
    return {
        (
            frozenset(world.true_atoms(state)),
            frozenset(compound),
            frozenset(world.true_atoms(after)),
        )
        for compound in subsets
        for state in world.states()
        for after in world.successors(state, compound)
    }
