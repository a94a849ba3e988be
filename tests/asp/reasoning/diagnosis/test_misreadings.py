"""Observations that rest on tests are taken for wrong where no events explain a history."""

import pytest

from asp.solving import ground, select
from tests.asp.reasoning.stories import CART, failed, lines
from tests.asp.theories.axioms import Without, domain_text, lettered, theory_text

AT_FIRST = "obs(at(left),true,0). obs(at(right),false,0). obs(shut,false,0)."
DARK = "obs(lit,false,0)."
NOW = 3

# What a history tells (the cart's lamp is lit by nobody but the agent), which tests were wrong, and
# a rule without which that does not follow.
SAID = {
    "what does not rest on tests is right": (
        lines("obs(lit,true,1). doubtful(lit,1). obs(lit,false,2)."),
        {("lit", 1)},
        Without("misreadings.a", 1),
    ),
    "the result of an attempt is right": (
        lines(failed(1, "go(right)"), "obs(at(left),true,1). obs(shut,false,1). doubtful(shut,1)."),
        {("shut", 1)},
        Without("misreadings.a", 2),
    ),
    "a test that no event explains was wrong": (
        lines(DARK, "obs(lit,true,2). doubtful(lit,2)."),
        {("lit", 2)},
        Without("misreadings.b", 1),
    ),
    "as few tests as possible were wrong": (
        lines(DARK, "obs(lit,false,1). obs(lit,true,3). doubtful(lit,(0;1;3))."),
        {("lit", 3)},
        Without("misreadings.b", 2),
    ),
    "of equally many those that were made earlier": (
        lines("obs(lit,true,1). obs(lit,false,3). doubtful(lit,(1;3))."),
        {("lit", 1)},
        Without("misreadings.b", 3),
    ),
}


def wrong(story: str, without: Without | None = None) -> set[frozenset[tuple[str, int]]]:
    """What was wrong by each of the best answer sets."""
    texts = [domain_text(CART), theory_text("conflict"), theory_text("misreadings", without)]
    control = ground([*texts, AT_FIRST, story, f"current_step({NOW})."], {"n": NOW}, ())
    control.configuration.solve.models = 0  # type: ignore[union-attr]
    control.configuration.solve.opt_mode = "optN"  # type: ignore[union-attr]
    with control.solve(yield_=True) as handle:
        best = [m.symbols(shown=True) for m in handle if m.optimality_proven or not m.cost]
    return {
        frozenset((str(fluent), step.number) for fluent, step in select(shown, "wrong", 2))
        for shown in best
    }


@pytest.mark.parametrize("sentence", SAID)
def test_what_is_said_of_wrong_tests(sentence: str) -> None:
    story, expected, _ = SAID[sentence]
    assert wrong(story) == {frozenset(expected)}


def test_every_rule_has_a_case() -> None:
    stated = {
        (number, rule)
        for number, block in lettered("misreadings").items()
        for rule in range(1, len(block.rules) + 1)
    }
    assert {(without.number, without.rule) for _, _, without in SAID.values()} == stated


@pytest.mark.parametrize("sentence", SAID)
def test_it_does_not_follow_without_its_rule(sentence: str) -> None:
    story, expected, without = SAID[sentence]
    assert wrong(story, without) != {frozenset(expected)}
