"""Which robots are compared, in which pairs, and where something exogenous is to happen."""

from typing import Any

import pytest

from testbed.analysis.comparison import Compared, compared, eventful, measured, with_apart
from testbed.analysis.table import table_of
from testbed.config import ConfigError, load_config
from testbed.experiment.record import Occurrence
from tests.experiment.samples import a_record, summary_of


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


@pytest.mark.parametrize(
    ("overrides", "expected"),
    [
        ([], [("traditional", "intentional")]),
        (["robots=[traditional,intentional]"], [("traditional", "intentional")]),
        (
            ["robots=[intentional-joint,traditional-plain]"],
            [("intentional-joint", "traditional-plain")],
        ),
        (["robots=[intentional,intentional-joint]"], [("intentional-joint", "intentional")]),
        (["robots=[intentional-joint,traditional]"], [("traditional", "intentional-joint")]),
        (["baseline=intentional"], [("intentional", "traditional")]),
        (["treatment=traditional"], [("intentional", "traditional")]),
        (
            [
                "robots=[intentional,intentional-joint,traditional]",
                "treatment=[intentional-joint,intentional]",
            ],
            [("traditional", "intentional-joint"), ("traditional", "intentional")],
        ),
        (["robots=[intentional]"], [("", "intentional")]),
    ],
)
def test_the_robots_of_the_published_study_are_compared_unless_others_are_named(
    overrides: list[str], expected: list[tuple[str, str]]
) -> None:
    assert list(compared(load_config("office", overrides))) == expected


@pytest.mark.parametrize(
    ("overrides", "key"),
    [
        (["baseline=intentional-joint"], "baseline"),
        (["treatment=[traditional,nobody]"], "treatment[1]"),
        (["treatment=[traditional,traditional]"], "treatment[1]"),
        (["baseline=traditional", "treatment=traditional"], "treatment[0]"),
        (["treatment=[intentional,traditional]"], "treatment"),
        (["robots=[intentional]", "baseline=intentional"], "baseline"),
    ],
)
def test_a_comparison_that_cannot_be_made_is_refused_in_one_line(
    overrides: list[str], key: str
) -> None:
    with pytest.raises(ConfigError) as refused:
        load_config("office", overrides)
    (line,) = refused.value.lines
    assert f" {key}: " in line


def _apart(robots: tuple[str, str], **trials: dict[str, Any]) -> str | None:
    """Of a pair in an eventful scenario, with a trial in another pair of each robot."""
    others = [a_record(f"other {name}", pair="other", robot=name) for name in (*robots, "third")]
    own = [a_record(name, pair="own", robot=name, **values) for name, values in trials.items()]
    found = with_apart(measured(table_of([*others, *own])), Compared(*robots), {"1"})
    (reason,) = found.filter(pair="own")["apart"].unique()
    return reason


EVENT: dict[str, Any] = {"exogenous": [Occurrence(2, "storm(north)", False)]}
LATE: dict[str, Any] = EVENT | {"deadline": True}


def test_a_pair_must_have_the_trials_of_both_robots_and_of_no_other() -> None:
    assert _apart(("a", "b"), a=EVENT, b=EVENT) is None
    assert _apart(("a", "b"), a={}, third={}) == "incomplete"
    assert _apart(("a", "b"), a=EVENT, b=LATE) == "deadline"
    assert _apart(("a", "b"), a=EVENT, b=EVENT, third=LATE) is None


def test_the_trial_of_the_treatment_says_whether_the_event_fired() -> None:
    assert _apart(("a", "b"), a=EVENT, b={}) == "no event"
    assert _apart(("b", "a"), a=EVENT, b={}) is None


def test_further_robots_are_compared_with_the_baseline_under_one_correction() -> None:
    needed = {"traditional": 8, "intentional": 4, "third": 2}
    records = [
        a_record(
            f"{name} {number}",
            pair=f"{number}",
            robot=name,
            initial=[f"s{number}"],
            action_count=own + number,
        )
        for number in range(6)
        for name, own in needed.items()
    ]
    group = summary_of(records, treatments=("intentional", "third"))["scenarios"]["1"]
    third = group["treatments"]["third"]
    for own, robot in ((group, "intentional"), (third, "third")):
        ratios = [(needed["traditional"] + n) / (needed[robot] + n) for n in range(6)]
        assert own["ratios"]["actions"] == pytest.approx(sum(ratios) / 6)
        # Six differences of one sign are 2 of 2^6 ways, each of the two tests one of two.
        assert own["p_values"]["actions"] == pytest.approx(2 / 2**6)
        assert own["holm"]["actions"] == pytest.approx(2 * 2 / 2**6)
    assert third["accuracy"]["third"] == 1.0
