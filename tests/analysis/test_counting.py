"""Which scenarios are to have an event, and whose trials a pair must have."""

import pytest

from testbed.analysis.counting import Standing, compared, eventful, pair_apart, why_apart
from testbed.config import load_config

PLAYED = Standing(lost=False, late=False, solvable=True, idle=False, quiet=False)
QUIET = Standing(lost=False, late=False, solvable=True, idle=False, quiet=True)


@pytest.mark.parametrize(
    ("name", "overrides", "expected"),
    [
        ("office", [], "23456"),
        ("office", ["scenarios=[1,3,random]"], "3"),
        ("office", ["scenarios=[1,3,random]", "adversary.rate=0.5"], "3"),
        ("quickstart", [], "23456"),
        ("office", ["scenarios=[1,2,3]", "script=[]"], ""),
        (
            "office",
            ["scenarios=[1,random]", "script=[{step: 3, action: 'exo_lock(library)'}]"],
            ["1", "random"],
        ),
        ("table1", [], "2345"),
        ("levels", [], ""),
    ],
)
def test_an_event_is_to_happen_where_one_is_scripted_or_sure_to_be_triggered(
    name: str, overrides: list[str], expected: str | list[str]
) -> None:
    assert eventful(load_config(name, overrides)) == set(expected)


def test_the_two_robots_are_compared_where_they_play_else_all() -> None:
    assert set(compared(["intentional", "traditional", "intentional-checking"])) == {
        "intentional",
        "traditional",
    }
    assert compared(["intentional", "intentional-nozoom"]) == ("intentional",)
    assert compared(["a", "b"]) == ("a", "b")


def test_a_missing_trial_is_told_before_anything_else() -> None:
    assert why_apart("2", [PLAYED, None], [PLAYED], {"2"}) == "incomplete"
    robots = ["intentional", "traditional"]
    assert pair_apart("2", {"intentional": QUIET}, robots, {"2"}) == "incomplete"


def test_a_pair_with_a_trial_that_the_clock_cut_off_counts_apart() -> None:
    late = Standing(lost=False, late=True, solvable=True, idle=False, quiet=False)
    assert why_apart("2", [PLAYED, late], [PLAYED], {"2"}) == "deadline"


def test_the_intentional_robots_trial_says_whether_the_event_fired() -> None:
    robots = ["traditional", "intentional"]
    other = {"traditional": PLAYED, "intentional": QUIET}
    assert pair_apart("2", other, robots, {"2"}) == "no event"
    own = {"traditional": QUIET, "intentional": PLAYED}
    assert pair_apart("2", own, robots, {"2"}) is None
    assert pair_apart("2", {"a": QUIET, "b": PLAYED}, ["a", "b"], {"2"}) is None
