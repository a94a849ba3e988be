"""The stated order of explanations that are equally good, however many there are to choose from."""

from itertools import product

import clingo
import pytest
from clingo import Symbol

from asp import load_description
from asp.solving import fact, ground, preferring
from tests.asp.reasoning.stories import CART, GATE_OPEN, GOAL, failed, lines, theories_for
from tests.asp.theories.axioms import domain_text, lettered, theory_text

EVENTS = load_description(CART).exogenous_actions
FLUENTS = ("at(left)", "at(right)", "shut", "lit")
DEFAULTS = ("first", "second")
NOW = 3

# What is seen leaves everything open: which default fails, what was so at first, when the gate was
# shut and by whom, and which news is false.
STORY = lines(
    GOAL,
    "default(first,lit,true). default(second,shut,false) :- -holds(at(left),0).",
    "obs(lit,false,1). initially(0,at(left)). initially(0,at(right)).",
    f"obs(shut,true,{NOW}). current_step({NOW}). explaining({NOW}).",
)
NEWS = lines(STORY, "hpd(push(right),true,1). hpd(push(right),true,0).")
FAILED = lines(failed(1, "go(right)"), "failing(go(right),1).")


def _story(
    rules: str, size: int, against: str | None = None, most: int = len(EVENTS)
) -> clingo.Control:
    """The program of a story; `against`: one paragraph of the order says the contrary."""
    ranks = [fact("ranks", most), *(fact("rank", e, n) for n, e in enumerate(EVENTS))]
    ranks += [fact("fluent_rank", fluent, n) for n, fluent in enumerate(FLUENTS)]
    ranks += [fact("default_rank", default, n) for n, default in enumerate(DEFAULTS)]
    constants = {"n": NOW, "max_name": 1, "max_len": 1, "max_unobserved": 3, "group_size": size}
    theories = [theory_text(name) for name in theories_for("diagnosis")]
    if against is not None:
        said = lettered("order")[against].text
        turned = said.replace(", true]", ", TRUE]")
        turned = turned.replace(", false]", ", true]").replace(", TRUE]", ", false]")
        theories = [text.replace(said, turned) for text in theories]
    return ground([domain_text(CART), *theories, rules], constants, ranks)


def _decisions(control: clingo.Control) -> list[tuple[int, Symbol, bool]]:
    """Every decision with its place, the first of all first, and whether it had rather be true."""
    found = []
    for atom in control.symbolic_atoms.by_signature("precedence", 2):
        what, place = atom.symbol.arguments
        found.append((place.number, what, what.name in ("unobserved", "unexecuted")))
    return sorted(found, reverse=True)


def _preferred(control: clingo.Control, assumptions: list[int]) -> tuple[bool, ...] | None:
    decisions = _decisions(control)
    with preferring(control, assumptions) as model:
        return None if model is None else tuple(model.contains(what) for _, what, _ in decisions)


def _best(control: clingo.Control, assumptions: list[int]) -> tuple[bool, ...] | None:
    """The best of all answer sets, compared decision by decision."""
    decisions = _decisions(control)
    control.configuration.solve.models = 0  # type: ignore[union-attr]
    with control.solve(assumptions=assumptions, yield_=True) as handle:
        choices = [tuple(m.contains(what) for _, what, _ in decisions) for m in handle]
    control.configuration.solve.models = 1  # type: ignore[union-attr]
    wanted = [rather for _, _, rather in decisions]
    return min(
        choices,
        key=lambda choice: [c != w for c, w in zip(choice, wanted, strict=True)],
        default=None,
    )


@pytest.mark.parametrize("size", [1, 2, 5, 32000])
@pytest.mark.parametrize(("events", "exceptions"), list(product(range(4), range(3))))
@pytest.mark.parametrize("story", [NEWS, lines(NEWS, FAILED)])
def test_the_preferred_explanation_is_the_best_of_all(
    story: str, events: int, exceptions: int, size: int
) -> None:
    control = _story(story, size)
    atoms = control.symbolic_atoms
    numbers = (fact("number_unobserved", events, NOW), fact("number_exceptions", exceptions))
    assumptions = [atoms[number].literal for number in numbers]  # type: ignore[union-attr]
    assert _preferred(control, assumptions) == _best(control, assumptions)


def test_no_two_decisions_have_one_place() -> None:
    places = [place for place, _, _ in _decisions(_story(STORY, 32000))]
    assert len(places) == len(set(places))
    of_steps, at_first = NOW * (2 * len(EVENTS) + 1), len(FLUENTS) + len(DEFAULTS)
    assert len(places) == of_steps + at_first
    assert min(places) > 0


@pytest.mark.parametrize("size", [1, 4, 32000])
def test_levels_stay_below_what_clasp_tells_apart(size: int) -> None:
    control = _story(STORY, size)
    decisions = control.symbolic_atoms.by_signature("decision", 3)
    levels = [atom.symbol.arguments[2].number for atom in decisions]
    assert 0 < min(levels) <= max(levels) <= min(size, 32767)


# What each paragraph says: a story, how many events and exceptions explain it, what is decided.
SAID = {
    "order.a": (lines(GATE_OPEN, "obs(shut,true,3)."), (1, 0), {"unobserved(shut_gate,2)": True}),
    "order.b": (
        "initially(0,at(left)). initially(0,at(right)). initially(1,lit). initially(1,shut).",
        (0, 0),
        {"holds(at(left),0)": True, "holds(shut,0)": True, "holds(lit,0)": False},
    ),
    "order.c": (
        "default(first,lit,true). default(second,lit,false).",
        (0, 1),
        {"exception(first)": False, "exception(second)": True},
    ),
    "order.d": (
        lines(GATE_OPEN, "hpd(shut_gate,true,0). hpd(shut_gate,true,2)."),
        (1, 0),
        {"distrusted(shut_gate,0)": True, "distrusted(shut_gate,2)": False},
    ),
    "order.e": (lines(GATE_OPEN, FAILED), (1, 0), {"distrusted(go(right),1)": True}),
}


def _is_told(paragraph: str, against: str | None = None) -> bool:
    rules, (events, exceptions), decided = SAID[paragraph]
    story = lines(GOAL, rules, f"current_step({NOW}). explaining({NOW}).")
    control = _story(story, 32000, against)
    numbers = (fact("number_unobserved", events, NOW), fact("number_exceptions", exceptions))
    assumptions = [control.symbolic_atoms[n].literal for n in numbers]  # type: ignore[union-attr]
    with preferring(control, assumptions) as model:
        assert model is not None
        return all(
            model.contains(clingo.parse_term(atom)) == truth for atom, truth in decided.items()
        )


@pytest.mark.parametrize("paragraph", SAID)
def test_what_is_preferred(paragraph: str) -> None:
    assert _is_told(paragraph)


def test_the_order_holds_beyond_the_levels_that_clasp_tells_apart() -> None:
    control = _story(NEWS, 32000, most=30000)
    assert max(place for place, _, _ in _decisions(control)) > 5 * 32767
    numbers = (fact("number_unobserved", 2, NOW), fact("number_exceptions", 1))
    assumptions = [control.symbolic_atoms[n].literal for n in numbers]  # type: ignore[union-attr]
    best = _best(control, assumptions)
    assert best is not None
    assert _preferred(control, assumptions) == best


def test_every_paragraph_of_the_order_has_a_story() -> None:
    assert set(lettered("order")) == set(SAID)


@pytest.mark.parametrize("paragraph", SAID)
def test_what_is_preferred_is_what_its_paragraph_says(paragraph: str) -> None:
    assert not _is_told(paragraph, against=paragraph)
