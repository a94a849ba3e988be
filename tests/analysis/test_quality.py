"""How well robots explained over many trials: shares of events, means, and tests of two robots."""

from typing import Any

import pytest

from asp.language import Literal
from testbed.experiment.record import At, Explained, FineCounts, Occurrence, TrialRecord
from tests.experiment.samples import a_record, summary_of

DRIFT, SINK = Literal.parse("drift(ferry,cove)"), Literal.parse("sink(buoy)")


def _trial(number: int, robot: str, *explained: Explained, **values: Any) -> TrialRecord:
    """A trial from a state of its own, in which the ferry drifts and the buoy sinks."""
    given: dict[str, Any] = {
        "pair": f"pair {number}",
        "initial": [f"moored(ferry{number})"],
        "exogenous": [Occurrence(1, DRIFT, False), Occurrence(2, SINK, False)],
        "explanations": [*explained],
    }
    return a_record(f"{robot} {number}", robot=robot, **given | values)


def _both(step: int) -> Explained:
    return Explained(step, [At(1, DRIFT), At(2, SINK)], [], alternatives=4)


def _wrong(step: int) -> Explained:
    return Explained(step, [At(2, DRIFT)], [])


def _of(records: list[TrialRecord]) -> Any:
    return summary_of(records)["scenarios"]["1"]


def test_shares_are_of_all_events_and_means_of_all_that_there_is_of() -> None:
    found = _of(
        [
            _trial(1, "intentional", _both(3), exogenous=[Occurrence(1, DRIFT, False)]),
            _trial(2, "intentional", _wrong(4), _both(6)),
            _trial(3, "intentional"),
            _trial(4, "intentional", _wrong(3), outcome="error", cause="robot"),
        ]
    )["explanations"]["intentional"]
    assert found == {
        "trials": 3,
        "unobserved": 5,
        "followed": 3,
        "adopted": 3,
        "more_alternatives": 0,
        "assumed": 5,
        "exceptions": 0,
        "distrusted": 0,
        "explained": 3 / 5,
        "latency": pytest.approx((2 + 3 + 4) / 3),
        "action_first": pytest.approx(2 / 3),
        "action_last": 1.0,
        "step_first": pytest.approx(1 / 3),
        "step_last": 1.0,
        "false": 1 / 5,
        "alternatives": pytest.approx(4.0),
        "false_exceptions": None,
        "wrongly_distrusted": None,
    }


def test_robots_are_compared_where_both_have_a_share() -> None:
    pairs = [
        own
        for number in range(5)
        for own in (
            _trial(number, "traditional", _wrong(4), action_count=9),
            _trial(number, "intentional", _both(3)),
        )
    ]
    silent = [_trial(9, "traditional"), _trial(9, "intentional", _both(3))]
    found = _of([*pairs, *silent])
    tests = found["explanation_tests"]
    # The first explanation of TP names one of the events, without its step.
    assert tests["effects"]["action_first"] == pytest.approx(1 / 2)
    assert tests["effects"]["step_first"] == pytest.approx(1.0)
    assert tests["p_values"]["action_first"] == pytest.approx(2 / 2**5)
    assert tests["effects"]["explained"] == pytest.approx((5 * 1 / 2 + 1) / 6)
    assert tests["p_values"]["explained"] == pytest.approx(2 / 2**6)
    # From the drift to the explanation 3 steps; from both events 2 and 1.
    assert tests["effects"]["latency"] == 1.0
    assert tests["p_values"]["alternatives"] is tests["p_values"]["false"] is None
    # Six tests there are of explanations; the others are corrected as without them.
    assert tests["holm"]["explained"] == pytest.approx(6 * 2 / 2**6)
    assert found["holm"]["actions"] == pytest.approx(found["p_values"]["actions"])


def test_robots_at_the_fine_resolution_have_no_such_numbers() -> None:
    found = _of([_trial(1, "intentional", fine=FineCounts())])
    assert found["explanations"] == {}
    assert set(found["explanation_tests"]["p_values"].values()) == {None}
